// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace rodeira::system_test {

// The words of a process's command line; none where it has ended.
inline std::vector<std::string> CommandLineOf(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/cmdline");
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

// The word behind `option`; empty: there is none.
inline std::string OptionOf(pid_t process, const std::string& option) {
  const std::vector<std::string> words = CommandLineOf(process);
  const auto at = std::ranges::find(words, option);
  return at == words.end() || at + 1 == words.end() ? "" : *(at + 1);
}

}  // namespace rodeira::system_test

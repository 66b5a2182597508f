// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

// What the clock and its followers say on standard output, a line a statement (docs/reference/run-control.md):
// `rodeira run` reads it, people may too.
namespace rodeira::dds {

// The line must hold no newline. It is written at once.
inline void SayLine(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

template <class... Args>
void Say(fmt::format_string<Args...> format, Args&&... args) {
  SayLine(fmt::format(format, std::forward<Args>(args)...));
}

// Newlines would end a statement.
inline std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace rodeira::dds

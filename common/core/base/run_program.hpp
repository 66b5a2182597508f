// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::base {

// The file of a program in $PATH; nothing where it is in none of its directories.
std::optional<std::filesystem::path> FindInPath(std::string_view program);

// A program to run, and how RunProgram waits for it.
struct ProgramRun {
  std::filesystem::path program;
  std::vector<std::string> arguments;                            // without the program's own name
  std::vector<std::pair<std::string, std::string>> environment;  // variables that are set where they are not
  std::chrono::seconds limit{600};                               // the program is killed after it
  int text_descriptor = 2;                                       // what it writes there is kept; 2: standard error
  std::size_t text_limit_bytes = 1u << 20;                       // of that
  bool is_own_group = false;                                     // a signal of the terminal does not reach it
  std::function<bool()> stop;                                    // asked often; true: the program is killed
};

// How a program ended. `status` counts where `signal` is 0.
struct ProgramEnd {
  int status = 0;        // exit status; 0 where a signal ended it
  int signal = 0;        // the signal that ended it; 0: it ended itself
  bool stopped = false;  // by `stop`
  bool too_long = false;
  std::string text;  // the beginning of what it wrote to `text_descriptor`
};

// Runs a program without a standard input, and waits for its end. What it writes to its standard output is dropped. Its
// standard error is this process's, unless it is kept.
// Failed where it cannot be started.
Result<ProgramEnd> RunProgram(const ProgramRun& run);

}  // namespace rodeira::base

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace rodeira::cli {

// `rodeira completion bash|zsh`, `rodeira manual [--markdown]`
struct ShellOptions {
  std::string command;  // "completion" or "manual"
  std::string shell;
  bool markdown = false;
};

// Prints the script or the page for the commands of `app`. Returns the exit status.
int Shell(const ShellOptions& options, const CLI::App& app);

}  // namespace rodeira::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

// `--json`: errors as JSON on standard error, one per line (base::ErrorJson).
namespace rodeira::cli {

// Declares `--json` at the program and at each of its commands. Called when all commands are declared.
void AddJson(CLI::App& app);

// Whether `--json` is among the arguments, up to `--`. Asked before parsing: the parser's errors are JSON, too.
bool WantsJson(int argc, const char* const* argv);

}  // namespace rodeira::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "common/core/base/result.hpp"

// One rule for every file and folder of results that an option names: what exists is refused, `--force` replaces it.
// Options belong to it by their validator, NewFile or NewFolder.
namespace rodeira::cli {

// A file to be written, in a folder that is there.
CLI::Validator NewFile();
// Beside NewFile: with a file that is named *`when` (any, where it is empty) another one is written, of the same name
// but for its `ending`.
CLI::Validator AlsoWrites(const std::string& ending, const std::string& when = "");
// A folder to write files into; it is made where it is missing.
CLI::Validator NewFolder();
// Beside NewFolder: a folder with a file of this name is one that the command wrote before; it is written again.
CLI::Validator RenewedWith(const std::string& file);

// Adds `--force` to each command of `app` with such an option.
void AddForce(CLI::App& app);

// After parsing: whether the command line of `command` has `--force`.
bool IsForced(const CLI::App& command);

// After parsing: wrong input where such an option of the chosen command names a regular file, also one beside it, or a
// folder that is not empty nor renewed, and the command line has no `--force`. Devices and pipes are written to.
base::Status CheckResults(CLI::App& app);

}  // namespace rodeira::cli

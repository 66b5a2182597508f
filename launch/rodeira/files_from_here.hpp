// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/runtime/launch/launch.hpp"

// Files that a command line names in a value of a launch file, `--set KEY=VALUE`: they are meant as seen from the
// current directory, while the launch file's own are relative to its folder.
namespace rodeira::cli {

// The value with each existing file in it, also within `{source: keyboard, keyboard: FILE}`, by its absolute path. A
// word without a folder and without an extension is no file.
std::string WithFilesFromHere(const std::string& value);

// The same for all overrides, with paths relative to the launch file's folder: PCs with the same folders agree on them.
// A recorder's `config.file` stays, it is written. A missing file is sought here, too, where only the current directory
// has its folder, or its name has none and no file of nearly that name lies beside the launch file alone: the error
// then names the nearest file here.
launch::Overrides WithFilesFromHere(const launch::Overrides& overrides, const std::filesystem::path& launch_file);

}  // namespace rodeira::cli

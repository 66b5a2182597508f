// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/input_files.hpp"

namespace rodeira::cli {

// Worlds and vehicles that a command line names in a value of a launch file: `world=town`,
// `nodes.ego.config.vehicle=kart`. A value that is no path of a file, from the current directory or from the launch
// file's, is looked up as `rodeira world list` and `rodeira vehicle list` print it, and becomes that file's path.
// Everything else stays. Wrong input: a bare name that is found nowhere; `option` is the option's name, for the
// message.
base::Result<launch::Overrides> WithNamedInputs(const launch::Overrides& overrides,
                                                const std::filesystem::path& launch_file, const char* option,
                                                const std::vector<InputFolder>& folders = InputFolders());

}  // namespace rodeira::cli

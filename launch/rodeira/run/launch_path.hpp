// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/core/base/result.hpp"

namespace rodeira::cli {

// The path by which all parts of a run read the launch file `file`. Where the file is reached by a linked folder, its
// relative paths are resolved against the real folder: "linked/../configs" is beside that one. Wrong input where the
// file cannot be read twice, as a pipe.
base::Result<std::string> LaunchPath(const std::string& file);

}  // namespace rodeira::cli

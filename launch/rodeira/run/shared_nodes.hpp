// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace rodeira::cli {

// The whole of a process that several nodes of a launch file share (key `process`): 0, 1 or 2. Their world is loaded
// once.
int RunSharedNodes(std::string_view program, int argc, char** argv);

}  // namespace rodeira::cli

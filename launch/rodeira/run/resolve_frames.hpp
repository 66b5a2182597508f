// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/run/placement.hpp"
#include "launch/rodeira/run/run_command.hpp"

namespace rodeira::cli {

// Names the folder of pictures (`frames`) of each view on this host that has no folder yet: RECORDING-frames
// beside `recording`, or a dated folder among the user's recordings if `recording` is empty. With several such views
// the node's name follows. Adds to `overrides`.
void ResolveFrames(const launch::Launch& launch, const Placement& placement, const std::string& recording,
                   launch::Overrides& overrides);

}  // namespace rodeira::cli

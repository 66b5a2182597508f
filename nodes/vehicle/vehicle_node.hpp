// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"

namespace rodeira::nodes {

// A vehicle: controls in, state and what it hits out, SUELO once a step. Configuration: `vehicle` (a vehicle file),
// `start` (x_m, y_m, heading_deg, speed_mps; default: the world's start at rest), `ground` (local, remote),
// `collisions` (all, traffic, none).
base::Result<std::unique_ptr<lockstep::Node>> MakeVehicleNode(launch::NodeContext& context);

}  // namespace rodeira::nodes

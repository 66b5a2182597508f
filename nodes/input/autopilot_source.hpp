// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"
#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// The autopilot of common/driving/driver at the wheel: sees the driver's car and the traffic as they are published,
// drives the lane in which the world's start lies, or the one that `lane` names.
base::Result<std::unique_ptr<Source>> MakeAutopilotSource(const config::Map& config, launch::NodeContext& context);

}  // namespace rodeira::nodes

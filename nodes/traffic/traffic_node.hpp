// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"

namespace rodeira::nodes {

// Autonomous traffic on the world's roads, all agents in one sample, and what the world's lights show in another.
// Configuration: common/traffic's settings (docs/reference/traffic-files.md), `vehicles` first of all. It sees every
// car with a state that is wired to it.
base::Result<std::unique_ptr<lockstep::Node>> MakeTrafficNode(launch::NodeContext& context);

}  // namespace rodeira::nodes

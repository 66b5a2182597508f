#pragma once

#include <memory>

#include "common/launch/node_context.hpp"

namespace rodeira::nodes {

// The driver's hands and feet. Configuration: `source: script`, with `script` (a CSV file, docs/formats.md), or `source:
// autopilot`, with `driver` (a driver file), `vehicle` (the vehicle file, for its measures) and optionally `lane`.
base::Result<std::unique_ptr<lockstep::Node>> MakeInputNode(launch::NodeContext& context);

}  // namespace rodeira::nodes

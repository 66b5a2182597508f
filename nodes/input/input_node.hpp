#pragma once

#include <memory>

#include "common/launch/node_context.hpp"

namespace rodeira::nodes {

// The driver's hands and feet. Configuration (files: docs/formats.md): `source: script`, with `script` (CSV); `source:
// autopilot`, with `driver`, `vehicle` (for its measures) and optionally `lane`; `source: keyboard`, with `keyboard`; `source:
// joystick`, with `wheel` and optionally `devices` (GUIDs that stand above the wheel file's).
base::Result<std::unique_ptr<lockstep::Node>> MakeInputNode(launch::NodeContext& context);

}  // namespace rodeira::nodes

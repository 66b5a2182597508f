// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"
#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// The driver's hands and feet. Configuration (files: docs/reference/driver-files.md): `source: script`, with `script`
// (CSV); `source: autopilot`, with `driver`, `vehicle` (for its measures) and optionally `lane`; `source: keyboard`,
// with `keyboard`; `source: joystick`, with `wheel` and optionally `devices` (GUIDs that stand above the wheel file's),
// or without `wheel` what is plugged in, and with `keyboard` the windows' keys where that is nothing; `source:
// gamepad`.
base::Result<std::unique_ptr<lockstep::Node>> MakeInputNode(launch::NodeContext& context);

// The same with a source that was made elsewhere; `base_step_ns` of the roster.
std::unique_ptr<lockstep::Node> InputNodeOf(std::unique_ptr<Source> source, std::int64_t base_step_ns);

}  // namespace rodeira::nodes

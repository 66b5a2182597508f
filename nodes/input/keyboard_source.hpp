// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"
#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// Drives by the keys that the run's windows forward (common/runtime/launch/live_keys.hpp), as a keyboard file says
// (docs/reference/driver-files.md). What is held at an activation becomes the controls of that activation.
base::Result<std::unique_ptr<Source>> MakeKeyboardSource(const config::Map& config, launch::NodeContext& context);

}  // namespace rodeira::nodes

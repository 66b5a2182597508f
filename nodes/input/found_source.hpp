// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"
#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// `source: joystick` that names no `wheel`: what is plugged in, the first of
// - a wheel with a file that `rodeira input setup` has written,
// - a steering wheel that was not set up, by its plain mapping (common/vehicle/input_devices/plain_wheel.hpp),
// - a game pad,
// - a device with a broken file, by its plain mapping too,
// - the windows' keys, where `keyboard` names their file.
// What is passed over on the way is said in a sentence. Wrong input where nothing is left.
base::Result<std::unique_ptr<Source>> MakeFoundSource(const config::Map& config, launch::NodeContext& context);

}  // namespace rodeira::nodes

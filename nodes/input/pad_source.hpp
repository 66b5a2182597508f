// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "common/runtime/launch/node_context.hpp"
#include "common/vehicle/input_devices/game_pad.hpp"
#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// A game pad, as common/vehicle/input_devices/pad_driver.hpp says. One that is unplugged during the run is told of, its
// pedals are released, the run goes on; the next one that is plugged in drives.
std::unique_ptr<Source> MakePadSource(const std::string& node, std::unique_ptr<input_devices::GamePad> pad);
// `source: gamepad`. Wrong input where none is there at the start.
base::Result<std::unique_ptr<Source>> MakePadSource(const config::Map& config, launch::NodeContext& context);

}  // namespace rodeira::nodes

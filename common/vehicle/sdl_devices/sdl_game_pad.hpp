// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/core/base/result.hpp"
#include "common/vehicle/input_devices/game_pad.hpp"

namespace rodeira::sdl_devices {

// The first game pad, by SDL's mapping of game controllers. Wrong input where SDL cannot look at devices at all.
base::Result<std::unique_ptr<input_devices::GamePad>> StartGamePad();

}  // namespace rodeira::sdl_devices

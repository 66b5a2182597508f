// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/core/base/result.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"

namespace rodeira::sdl_devices {

// SDL's joysticks: its game-controller layer leaves wheels out. Wrong input where SDL cannot look at devices at all.
base::Result<std::unique_ptr<input_devices::Joysticks>> StartJoysticks();

}  // namespace rodeira::sdl_devices

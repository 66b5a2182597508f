// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/vehicle/input_devices/force_device.hpp"

struct _SDL_Joystick;

namespace rodeira::sdl_devices {

// The motor of a wheel that SDL knows as haptic: one constant force along the steering axis. Null where the device has
// none. The joystick must be open. `inverted`: for devices with a driver that turns the direction round.
std::unique_ptr<input_devices::ForceDevice> OpenHapticForce(_SDL_Joystick* joystick, bool inverted);

}  // namespace rodeira::sdl_devices

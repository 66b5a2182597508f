// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/core/base/result.hpp"
#include "common/vehicle/input_devices/game_pad.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"

namespace rodeira::input_devices {

// How a program reaches devices. Programs that link common/vehicle/sdl_devices register its access; others have none.
struct DeviceAccess {
  base::Result<std::unique_ptr<Joysticks>> (*joysticks)() = nullptr;
  base::Result<std::unique_ptr<GamePad>> (*game_pad)() = nullptr;
};

// Registers the access, at the start of a program, before other threads; both functions are given.
void UseDeviceAccess(const DeviceAccess& access);
// False in programs that cannot reach any device.
bool HasDeviceAccess();

}  // namespace rodeira::input_devices

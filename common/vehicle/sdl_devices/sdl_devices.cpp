// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/sdl_devices/sdl_devices.hpp"

#include "common/vehicle/input_devices/device_access.hpp"
#include "common/vehicle/sdl_devices/sdl_game_pad.hpp"
#include "common/vehicle/sdl_devices/sdl_joysticks.hpp"

namespace rodeira::sdl_devices {

void UseSdlDevices() { input_devices::UseDeviceAccess({StartJoysticks, StartGamePad}); }

}  // namespace rodeira::sdl_devices

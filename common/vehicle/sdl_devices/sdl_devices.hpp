// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::sdl_devices {

// Registers SDL's joysticks and game pads as the program's device access (input_devices/device_access.hpp). SDL starts
// with the first device that is opened.
void UseSdlDevices();

}  // namespace rodeira::sdl_devices

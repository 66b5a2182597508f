// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/sdl_devices/sdl_devices.hpp"
#include "nodes/input/use_devices.hpp"

namespace rodeira::nodes {

void UseDevices() { sdl_devices::UseSdlDevices(); }

}  // namespace rodeira::nodes

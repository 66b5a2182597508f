// SPDX-License-Identifier: Apache-2.0
// rodeira-graphics: the front door with everything that draws, and with wheels and game pads.
#include "common/vehicle/sdl_devices/sdl_devices.hpp"
#include "launch/rodeira/commands.hpp"
#include "launch/rodeira/graphics/all_graphics.hpp"

int main(int argc, char** argv) {
  rodeira::sdl_devices::UseSdlDevices();
  rodeira::cli::UseAllGraphics();
  return rodeira::cli::Main(argc, argv);
}

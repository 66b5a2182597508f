// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/sdl_devices/sdl_devices.hpp"
#include "launch/rodeira/commands.hpp"

int main(int argc, char** argv) {
  rodeira::sdl_devices::UseSdlDevices();
  return rodeira::cli::Main(argc, argv);
}

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "common/core/base/mathematics.hpp"
#include "common/vehicle/sdl_devices/sdl_devices.hpp"
#include "launch/rodeira/graphics/all_graphics.hpp"

// The runs here must compute like the programs do (law L7); what draws is registered as in rodeira-graphics.
int main(int argc, char** argv) {
  rodeira::base::PinMathLibrary(argv);
  rodeira::sdl_devices::UseSdlDevices();
  rodeira::cli::UseAllGraphics();
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

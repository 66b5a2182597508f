// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "common/core/base/mathematics.hpp"
#include "common/vehicle/sdl_devices/sdl_devices.hpp"

// The runs here must compute like the programs do (law L7); devices are SDL's.
int main(int argc, char** argv) {
  rodeira::base::FixMathematics(argv);
  rodeira::sdl_devices::UseSdlDevices();
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

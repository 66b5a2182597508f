// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "common/vehicle/sdl_devices/sdl_devices.hpp"

int main(int argc, char** argv) {
  rodeira::sdl_devices::UseSdlDevices();
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

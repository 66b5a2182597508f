// SPDX-License-Identifier: Apache-2.0
// Promises of callers of input devices: a step has a length, each device of the settings a reading.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/vehicle/input_devices/keyboard_driver.hpp"
#include "common/vehicle/input_devices/pad_driver.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "common/vehicle/input_devices/wheel_setup.hpp"

namespace rodeira::input_devices {
namespace {

const std::vector<DeviceUse> kOneDevice{{"wheel", std::string(32, 'a'), ""}};

TEST(ContractsDeathTest, AStepIsLongerThanNothing) {
  KeyboardDriver keys{KeyboardSettings()};
  PadDriver pad{PadSettings()};
  for (const double dt_s : {0.0, -0.01}) {
    EXPECT_DEATH((void)keys.Step({}, dt_s), "keyboard_driver.cpp.*dt_s > 0.0");
    EXPECT_DEATH((void)pad.Step({}, 1, 0.0, dt_s), "pad_driver.cpp.*dt_s > 0.0");
  }
  EXPECT_EQ(keys.Step({}, 0.01).throttle, 0.0);
  EXPECT_EQ(pad.Step({}, 1, 0.0, 0.01).throttle, 0.0);
}

TEST(ContractsDeathTest, EachDeviceOfAWheelHasAReading) {
  WheelSettings settings;
  settings.devices = kOneDevice;
  WheelDriver wheel(settings);
  EXPECT_EQ(wheel.Step(std::vector<DeviceReading>(1), 1).throttle, 0.0);
  EXPECT_DEATH((void)wheel.Step({}, 1), "wheel_driver.cpp.*devices.size\\(\\)");
  EXPECT_DEATH((void)wheel.Step(std::vector<DeviceReading>(2), 1), "wheel_driver.cpp.*devices.size\\(\\)");
}

TEST(ContractsDeathTest, ASetupReadsEachOfItsDevicesAndHasSettingsOnceItIsDone) {
  WheelSetup setup(kOneDevice, 7.85);
  setup.Step(std::vector<DeviceReading>(1), 0.01);
  EXPECT_DEATH(setup.Step({}, 0.01), "wheel_setup.cpp.*devices.size\\(\\)");
  EXPECT_DEATH(setup.Step(std::vector<DeviceReading>(1), 0.0), "wheel_setup.cpp.*dt_s > 0.0");
  EXPECT_DEATH((void)setup.settings(), "stage_ == Stage::kDone");
}

}  // namespace
}  // namespace rodeira::input_devices

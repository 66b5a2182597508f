// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/gear_selector.hpp"

#include <gtest/gtest.h>

namespace rodeira::input_devices {
namespace {

using dynamics::GearboxMode;

dynamics::Controls Shown(const GearSelector& lever) {
  dynamics::Controls controls;
  lever.Show(controls);
  return controls;
}

TEST(GearSelector, AutomaticHasReverseNeutralAndDrive) {
  GearSelector lever(5);
  EXPECT_EQ(Shown(lever).gear, 1);
  EXPECT_EQ(Shown(lever).gearbox, GearboxMode::kAutomatic);
  lever.Step({.up = 1, .engaged = 3});
  EXPECT_EQ(Shown(lever).gear, 1) << "there is nothing above D";
  lever.Step({.down = 1, .engaged = 3});
  EXPECT_EQ(Shown(lever).gear, 0);
  lever.Step({.down = 5, .engaged = 0});
  EXPECT_EQ(Shown(lever).gear, -1);
  lever.Step({.up = 2, .engaged = -1});
  EXPECT_EQ(Shown(lever).gear, 1);
}

TEST(GearSelector, ManualBeginsWithTheGearThatIsIn) {
  GearSelector lever(5);
  lever.Step({.mode = 1, .engaged = 3});
  EXPECT_EQ(Shown(lever).gearbox, GearboxMode::kManual);
  EXPECT_EQ(Shown(lever).gear, 3);
  lever.Step({.up = 1, .engaged = 3});
  EXPECT_EQ(Shown(lever).gear, 4);
  lever.Step({.up = 9, .engaged = 4});
  EXPECT_EQ(Shown(lever).gear, 5) << "the car has five";
  lever.Step({.mode = 1, .engaged = 5});
  EXPECT_EQ(Shown(lever).gearbox, GearboxMode::kAutomatic);
  EXPECT_EQ(Shown(lever).gear, 1) << "D";
  lever.Step({.mode = 2, .engaged = 5});
  EXPECT_EQ(Shown(lever).gearbox, GearboxMode::kAutomatic) << "two presses between two steps undo one another";
}

TEST(GearSelector, UpAndDownBetweenTwoStepsBothCount) {
  GearSelector lever(5, GearboxMode::kManual);
  lever.Step({.up = 3, .down = 1, .engaged = 1});
  EXPECT_EQ(Shown(lever).gear, 3);
}

}  // namespace
}  // namespace rodeira::input_devices

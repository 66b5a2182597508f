// SPDX-License-Identifier: Apache-2.0
// A car that is left standing on a hill, in a run of one process; the test holds the keys.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/input/live_drive.hpp"

namespace rodeira {
namespace {

// On N222, with its start on a grade.
LiveDrive DriveOnAHill(const KeyScript& script, lockstep::Step last, const std::string& start = "") {
  return DriveByKeys(
      "rodeira: launch/1\nworld: ../configs/worlds/n222.yaml\nnodes:\n  road: {kind: road}\n  driver: {kind: input, "
      "config: {source: keyboard, keyboard: ../configs/drivers/keyboard.yaml}}\n"
      "  ego: {kind: vehicle, config: {vehicle: ../configs/vehicles/default.yaml" +
          start + "}}\n",
      script, last);
}

double Speed(const LiveDrive& drive) {
  const auto& v = drive.last.velocity_w_mps();
  return std::hypot(v.x(), v.y());
}

TEST(Parked, ACarStandsUntilItIsDriven) {
  const LiveDrive waits = DriveOnAHill({}, 6000);
  EXPECT_LT(Speed(waits), 1e-3);
  EXPECT_EQ(waits.controls.at(0).handbrake(), 0.0) << "nothing is seen yet";
  EXPECT_EQ(waits.controls.at(10).handbrake(), 1.0);
  EXPECT_EQ(waits.controls.at(6000).handbrake(), 1.0);

  const LiveDrive drives = DriveOnAHill({{1000, {"w"}}}, 6000);
  EXPECT_EQ(drives.controls.at(1000).handbrake(), 1.0);
  EXPECT_EQ(drives.controls.at(1100).handbrake(), 0.0) << "let go with the first throttle";
  EXPECT_GT(Speed(drives), 3.0);
}

TEST(Parked, APulledHandbrakeIsReleasedByThePuller) {
  const LiveDrive rolls = DriveOnAHill({{1000, {"b"}}, {2000, {}}}, 8000);
  EXPECT_EQ(rolls.controls.at(1500).handbrake(), 1.0);
  EXPECT_EQ(rolls.controls.at(3000).handbrake(), 0.0);
  EXPECT_GT(Speed(rolls), 0.2) << "down the hill";
}

TEST(Parked, ACarThatMovesIsNotHeld) {
  const LiveDrive moves = DriveOnAHill({}, 1000, ", start: {speed_mps: 15}");
  ASSERT_TRUE(moves.controls.contains(10) && moves.controls.contains(1000));
  EXPECT_GT(Speed(moves), 10.0);
  for (const auto& [step, controls] : moves.controls) EXPECT_EQ(controls.handbrake(), 0.0) << step;
}

}  // namespace
}  // namespace rodeira

// A car that is left standing on a hill, in a run of one process; the test holds the keys.
#include <gtest/gtest.h>

#include <cmath>

#include "common/hands/keyboard_driver.hpp"
#include "tests/nodes/input/live_drive.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

// Keys down from a step on (until the next entry), on N222, whose start is on a grade.
LiveDrive DriveOnAHill(const std::map<lockstep::Step, std::vector<std::string>>& script, lockstep::Step last, const std::string& more = "") {
  const std::string text =
      "rodeira: launch/1\nworld: ../configs/worlds/n222.yaml\nnodes:\n  road: {kind: road}\n  driver: {kind: input, config: {source: keyboard, keyboard: ../configs/drivers/keyboard.yaml}}\n"
      "  ego: {kind: vehicle, config: {vehicle: ../configs/vehicles/default.yaml" + more + "}}\n";
  const auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/live.yaml");
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = front::LocalNodes::Make(launch.value());
  EXPECT_TRUE(nodes.ok()) << nodes.error().Text();
  const auto window = nodes.value().keys().MakeSender();
  std::map<hands::Key, launch::LiveKey> keys;
  return DriveLive(launch.value(), nodes.value(), last, [&](lockstep::Step step) {
    if (const auto now = script.find(step); now != script.end()) {
      for (auto& [key, entry] : keys) entry.held = false;
      for (const std::string& name : now->second) {
        launch::LiveKey& entry = keys[hands::KeyOf(name).value()];
        entry.key = hands::KeyOf(name).value();
        entry.held = true;
        ++entry.presses;
      }
    }
    std::vector<launch::LiveKey> all;
    for (const auto& [key, entry] : keys) all.push_back(entry);
    window->Say(std::move(all));
  });
}

double Speed(const LiveDrive& drive) {
  const auto& v = drive.last.velocity_w_mps();
  return std::hypot(v.x(), v.y());
}

TEST(Parked, ACarStandsUntilSomebodyDrives) {
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

TEST(Parked, WhoPullsTheHandbrakeHimselfLetsItGo) {
  const LiveDrive rolls = DriveOnAHill({{1000, {"b"}}, {2000, {}}}, 8000);
  EXPECT_EQ(rolls.controls.at(1500).handbrake(), 1.0);
  EXPECT_EQ(rolls.controls.at(3000).handbrake(), 0.0);
  EXPECT_GT(Speed(rolls), 0.2) << "down the hill";
}

TEST(Parked, ACarThatMovesIsNotHeld) {
  const LiveDrive moves = DriveOnAHill({}, 1000, ", start: {speed_mps: 15}");
  for (const auto& [step, controls] : moves.controls) EXPECT_EQ(controls.handbrake(), 0.0) << step;
}

}  // namespace
}  // namespace rodeira

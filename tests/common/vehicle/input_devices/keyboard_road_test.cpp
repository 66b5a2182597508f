// SPDX-License-Identifier: Apache-2.0
// A beginner at the keyboard, a person with keys that are down or up, without angles, keep the lane of a winding
// road.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "common/driving/driver/speed_plan.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/input_devices/keyboard_driver.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/lane_path.hpp"
#include "tests/tree.hpp"

namespace rodeira::input_devices {
namespace {

const std::filesystem::path kConfigs = std::filesystem::path(SourceDir()) / "configs";
constexpr double kHalfLane_m = 1.5;
constexpr double kLost_m = 6.0;

// Looks so far ahead in time, decides so often, does nothing about less than that, and the fingers follow later.
struct Person {
  double preview_s = 0.0;
  double dead_m = 0.0;
  int decides_ms = 0;
  int delay_ms = 0;
};

// Left, right or neither; throttle, brake or neither.
KeyboardInput ReactTo(const Person& person, const dynamics::VehicleState& state, const driver::LanePath& path,
                      double d_m, double allowed_mps) {
  const Eigen::Vector3d v_B = state.q_WB.conjugate() * state.v_WB_W;
  const double ahead_m = std::max(5.0, person.preview_s * v_B.x());
  const Eigen::Vector3d target_B = state.q_WB.conjugate() * (path.At(d_m + ahead_m).p_W - state.p_WB_W);
  // Where the car will be beside its own axis if nothing changes: the arc of the present turn.
  const double time_s = ahead_m / std::max(v_B.x(), 1.0);
  const double aside_m = target_B.y() - 0.5 * v_B.x() * state.w_WB_B.z() * time_s * time_s;
  KeyboardInput keys;
  const auto press = [&](Action action, bool held) { keys.held[static_cast<std::size_t>(action)] = held; };
  press(Action::kSteerLeft, aside_m > person.dead_m);
  press(Action::kSteerRight, aside_m < -person.dead_m);
  press(Action::kThrottle, v_B.x() < allowed_mps - 0.5);
  press(Action::kBrake, v_B.x() > allowed_mps + 1.0);
  return keys;
}

struct Drive {
  double worst_m = 0.0;  // farthest from the lane's middle
  double fastest_mps = 0.0;
  bool arrived = false;
};

// Bends of 35 m and more, at speeds up to 20 m/s, from rest to shortly before the road's end.
Drive DriveBy(const Person& person, const KeyboardSettings& settings) {
  const road::RoadSpec spec = driver::WindingRoad();
  const Version1Road road(spec);
  const auto world = driver::WorldOf(spec);
  const auto ground = world->MakeGround();
  const driver::LanePath path(road, -1);
  const driver::SpeedPlan plan(path, {.lateral_mps2 = 2.0, .stop_at_end = true});
  auto car = dynamics::LoadVehicle(kConfigs / "vehicles/default.yaml").value();
  const driver::LaneFrame start = path.At(5.0);
  EXPECT_TRUE(
      car->Initialise(
             {.x_m = start.p_W.x(), .y_m = start.p_W.y(), .z_hint_m = start.p_W.z(), .heading_rad = start.heading_rad},
             *ground)
          .ok());
  KeyboardDriver driver(settings);
  std::deque<KeyboardInput> on_the_way(static_cast<std::size_t>(person.delay_ms / 10));
  KeyboardInput decided;
  Drive drive;
  for (int ms = 0; ms < 180'000 && drive.worst_m < kLost_m; ++ms) {
    const auto place = path.Locate(car->state().p_WB_W.x(), car->state().p_WB_W.y());
    if (!place) return drive;
    drive.worst_m = std::max(drive.worst_m, std::fabs(place->offset_m));
    drive.arrived = place->d_m > path.length_m() - 40.0;
    if (drive.arrived) return drive;
    if (ms % person.decides_ms == 0)
      decided = ReactTo(person, car->state(), path, place->d_m, plan.At(place->d_m + 5.0).speed_mps);
    if (ms % 10 == 0) {
      on_the_way.push_back(decided);
      KeyboardInput input = on_the_way.front();
      on_the_way.pop_front();
      input.speed_mps = (car->state().q_WB.conjugate() * car->state().v_WB_W).x();
      drive.fastest_mps = std::max(drive.fastest_mps, input.speed_mps);
      driver.Step(input, 0.01);
    }
    car->Step(driver.controls(), *ground, 0.001);
  }
  return drive;
}

const Person kPeople[] = {{0.8, 0.2, 100, 150}, {1.1, 0.3, 100, 200}, {1.0, 0.3, 150, 200}};

TEST(KeyboardRoad, BeginnersKeepTheLaneThroughBendsOf35Metres) {
  const auto settings = LoadKeyboard(kConfigs / "drivers/keyboard.yaml");
  ASSERT_TRUE(settings.ok()) << settings.error().Text();
  for (const Person& person : kPeople) {
    const Drive drive = DriveBy(person, settings.value());
    EXPECT_TRUE(drive.arrived);
    EXPECT_GT(drive.fastest_mps, 12.0);
    EXPECT_LT(drive.worst_m, kHalfLane_m) << "the car's middle never leaves the lane";
  }
}

TEST(KeyboardRoad, WithAWheelThatCentresSlowlyTheyDoNot) {
  KeyboardSettings settings = LoadKeyboard(kConfigs / "drivers/keyboard.yaml").value();
  settings.centre_s = 1.2;
  for (const Person& person : kPeople) EXPECT_GE(DriveBy(person, settings).worst_m, kLost_m);
}

}  // namespace
}  // namespace rodeira::input_devices

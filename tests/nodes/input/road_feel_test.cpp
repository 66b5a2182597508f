// SPDX-License-Identifier: Apache-2.0
// What a rough road is in the hands: the proving ground's uneven lane, the wheel held straight.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/vehicle/input_devices/force_feedback.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "nodes/input/car_seen.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

constexpr double kSpeed_mps = 20.0;
constexpr int kPeriod_steps = 10;  // of an input node
constexpr double kOnLane_m = 1.0;  // a car 1.8 m wide on a lane of 4 m

struct Seen {
  double time_s, s_m, aside_m;
  nodes::CarSeen car;
};

// Along the lane from its beginning to its end, as an input node sees the car; it is not steered.
std::vector<Seen> DriveStraight() {
  const auto folder = base::TemporaryFolder::Make("road_feel");
  EXPECT_TRUE(folder.ok());
  const auto script = folder.value().path() / "straight.csv";
  EXPECT_TRUE(
      base::WriteWhole(script, std::string_view("time_s,steering_wheel_deg,throttle,brake\n0,0,0.3,0\n60,0,0.3,0\n"))
          .ok());
  const std::string text =
      "rodeira: launch/1\nworld: ../configs/worlds/flat.yaml\nnodes:\n  road: {kind: road}\n  driver: {kind: input, "
      "config: {source: script, script: \"" +
      script.string() +
      "\"}}\n  ego: {kind: vehicle, config: {vehicle: ../configs/vehicles/default.yaml, start: {x_m: -498, y_m: -122, "
      "heading_deg: 0, speed_mps: 20}}}\n";
  auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/road_feel.yaml");
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = cli::LocalNodes::Make(launch.value());
  EXPECT_TRUE(nodes.ok()) << nodes.error().Text();
  std::vector<Seen> seen;
  lockstep::InProcessSettings settings;
  settings.last_step = 24'000;
  settings.on_sample = [&](const lockstep::Sample& sample) {
    if (launch.value().roster().source(sample.source()).topic != idl::topics::kVehicleState ||
        sample.valid() % kPeriod_steps != 0)
      return;
    const auto state = idl::Decode<msg::VehicleState>(*sample.payload).value();
    seen.push_back({1e-3 * static_cast<double>(sample.valid()), state.position_w_m().x() + 500.0,
                    state.position_w_m().y() + 122.0, nodes::SeenOf(state)});
  };
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings);
  EXPECT_TRUE(outcome.ok) << outcome.fault;
  return seen;
}

// The rim's torque where the car is between two stations: its root mean square, in Nm.
double Felt_Nm(const std::vector<Seen>& drive, const input_devices::ForceSettings& settings, double from_m,
               double to_m) {
  input_devices::ForceFeedback law(settings);
  double squares = 0.0;
  int count = 0;
  for (const Seen& seen : drive) {
    const double share =
        law.Step({0.0, 7.85, seen.car.steering_torque_Nm, seen.car.front_load_difference_N}, seen.time_s);
    EXPECT_LE(std::fabs(share), 1.0);
    if (seen.s_m < from_m || seen.s_m > to_m) continue;
    squares += std::pow(share * settings.device_Nm, 2);
    ++count;
  }
  EXPECT_GT(count, 50);
  return std::sqrt(squares / count);
}

TEST(RoadFeel, ARoughRoadIsFeltWithTheWheelStraightAndASmoothOneIsNot) {
  const std::vector<Seen> drive = DriveStraight();
  ASSERT_GT(drive.back().s_m, 450.0);
  for (const Seen& seen : drive) {
    if (seen.s_m > 450.0) break;
    ASSERT_NEAR(seen.aside_m, 0.0, kOnLane_m) << "on its lane at " << seen.s_m;
    ASSERT_NEAR(seen.car.speed_mps, kSpeed_mps, 6.0) << seen.s_m;
  }
  input_devices::ForceSettings settings;
  const double smooth = Felt_Nm(drive, settings, 175.0, 195.0), a = Felt_Nm(drive, settings, 60.0, 150.0),
               c = Felt_Nm(drive, settings, 210.0, 300.0), e = Felt_Nm(drive, settings, 360.0, 450.0);
  EXPECT_LT(smooth, 0.002);
  EXPECT_GT(a, 5.0 * smooth);
  EXPECT_GT(c, 2.0 * a);
  EXPECT_GT(e, 1.5 * c) << "each is four times as rough as the one before, and a motor has its end";
  settings.road_feel = 0.0;
  const double without = Felt_Nm(drive, settings, 210.0, 300.0);
  EXPECT_LT(without, 0.25 * c) << "trail times side force knows little of it";
  std::printf("felt at the rim, Nm RMS: smooth %.4f, A %.4f, C %.4f, E %.4f; C without road_feel %.4f\n", smooth, a, c,
              e, without);
}

}  // namespace
}  // namespace rodeira

// SPDX-License-Identifier: Apache-2.0
// What agents with the physics of the driver's car do on the road: stop at lights, change lanes, overtake, brake.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/traffic/results/study.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/lanes/signs.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/traffic/two_way_ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/long_form.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

TrafficSettings Full(std::uint32_t vehicles) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.physics = Physics::kFull;
  return settings;
}

// On a level crossing without lights a car slows down harder than 3 m/s² only within a second after a change of gear:
// the foot itself never asks the brake for so much there. That does not hold everywhere (docs/explanation/traffic.md).
TEST(FullDrive, BrakesHardOnlyWhileAGearTakesHold) {
  constexpr double kStep_s = 0.01, kHard_mps2 = 3.0, kTakesHold_s = 1.0;
  TrafficModel model = TrafficModel::Make(Full(24), lanes::MapNetwork("crossing"), {}).value();
  struct Before {
    int gear = 0;
    double since_s = 1e9;
    double acceleration_mps2 = 0.0;
    std::uint32_t trip = 0;
  };
  std::vector<double> jerks_mps3, shifting_mps3;
  std::vector<Before> before(model.vehicles());
  double foot_mps2 = 0.0;
  int hard = 0;
  for (int i = 0; i < 4000; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) {
      const Driving& driving = model.agent(pose.id).driving;
      Before& b = before[pose.id];
      b.since_s = driving.gear == b.gear ? b.since_s + kStep_s : 0.0;
      b.gear = driving.gear;
      const double jerk_mps3 = std::fabs(pose.acceleration_mps2 - b.acceleration_mps2) / kStep_s;
      const bool same_trip = b.trip == pose.trip && i > 0;
      b.acceleration_mps2 = pose.acceleration_mps2, b.trip = pose.trip;
      if (pose.speed_mps < 0.5) continue;  // one that stands has its foot on the brake
      if (same_trip) (b.since_s < kTakesHold_s ? shifting_mps3 : jerks_mps3).push_back(jerk_mps3);
      const dynamics::BicycleSettings& car = CarOfBody(model.traits(pose.id).body);
      foot_mps2 = std::max(foot_mps2, driving.brake * FullBrake_N(car) / car.body.mass_kg);
      if (pose.acceleration_mps2 > -kHard_mps2) continue;
      ++hard;
      EXPECT_LT(b.since_s, kTakesHold_s) << "car " << pose.id << " at " << i * kStep_s << " s, "
                                         << pose.acceleration_mps2 << " m/s2";
    }
  }
  EXPECT_LE(foot_mps2, kHard_mps2);
  EXPECT_GT(hard, 0);  // it says something
  for (auto* all : {&jerks_mps3, &shifting_mps3}) {
    std::sort(all->begin(), all->end());
    ASSERT_FALSE(all->empty());
    const auto part = [&](double share) {
      return (*all)[static_cast<std::size_t>(share * static_cast<double>(all->size() - 1))];
    };
    const std::string name = all == &jerks_mps3 ? "driven" : "shifting";
    RecordProperty(name + "_jerk_mps3", fmt::format("median {:.2f}, 95 % {:.2f}, 99 % {:.2f}, most {:.2f}, of {} steps",
                                                    part(0.5), part(0.95), part(0.99), part(1.0), all->size()));
  }
  RecordProperty("foot_mps2", std::to_string(foot_mps2));
  RecordProperty("hard_steps", std::to_string(hard));
}

// A vehicle that crosses a light's line does so at green or amber.
TEST(FullDrive, NoVehiclePassesAtRed) {
  TrafficModel model = TrafficModel::Make(Full(30), lanes::MapNetwork("lights"), {}).value();
  std::vector<std::optional<double>> gaps(model.vehicles());
  int passed = 0;
  for (int i = 0; i < BriefOrLong(5000, 9000); ++i) {
    const std::vector<network::LightColour> colours = model.colours();
    model.Step(0.01, {});
    for (const AgentPose& pose : model.poses()) {
      const Agent& agent = model.agent(pose.id);
      std::optional<double> gap;
      for (const Piece& piece : agent.path) {
        const auto lights = lanes::LightsOf(model.graph(), piece.track);
        if (lights.empty() || piece.begin_m > agent.o_m) continue;
        gap = piece.zero_m + lights[0].d_m - agent.o_m - 0.5 * model.traits(pose.id).length_m;
        if (gaps[pose.id] && *gaps[pose.id] >= 0.0 && *gap < 0.0) {
          EXPECT_NE(colours[lights[0].controller], network::LightColour::kRed)
              << "car " << pose.id << " at " << 0.01 * i << " s";
          ++passed;
        }
        break;
      }
      gaps[pose.id] = gap;
    }
  }
  EXPECT_GT(passed, 10);
}

// Cars, vans, lorries and buses on two lanes of a direction pass one another, touch no other and keep to the road.
TEST(FullDrive, LanesAreChangedOnTheMotorway) {
  const auto world = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/motorway.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  StudySettings settings;
  settings.traffic = Full(50);
  settings.traffic.mix.shares = {0.7, 0.1, 0.1, 0.1};
  settings.traffic.speed_factor_low = 0.6;
  settings.duration_s = BriefOrLong(25.0, 40.0);
  std::vector<int> side(50, 0);
  int changes = 0;
  const StudyResult r = RunStudy(settings, NetworkOf(world.value()), [&](const StudyMoment& moment) {
                          for (const AgentPose& pose : moment.model.poses()) {
                            const int now = moment.model.agent(pose.id).change.side;
                            if (now != 0 && side[pose.id] == 0) ++changes;
                            side[pose.id] = now;
                          }
                        }).value();
  EXPECT_EQ(r.collisions, 0);
  EXPECT_EQ(r.off_lane, 0);
  EXPECT_GT(changes, 5);
}

// A crawling car is passed on the lane of oncoming traffic; one that comes is two seconds away at least, and no vehicle
// is touched.
TEST(FullDrive, SlowOnesAreOvertaken) {
  TrafficSettings settings = Full(12);
  settings.speed_factor_low = 0.9;
  TrafficModel model = TrafficModel::Make(settings, TwoWayRing(Mark("broken")), {}).value();
  model.CapSpeed(3, 8.0);
  model.CapSpeed(9, 8.0);
  RingWatch watch;
  for (int i = 0; i < 15000; ++i) {
    model.Step(0.01, {});
    if (i % 2 == 0) watch.Observe(model, i * 0.01);
  }
  EXPECT_TRUE(watch.touches.empty());
  EXPECT_GE(watch.passes, 2);
  EXPECT_FALSE(watch.crossings.empty());
  for (const RingWatch::Crossing& c : watch.crossings) EXPECT_GE(c.spare_s, 2.0) << "car " << c.id;
}

struct RealDrive {
  std::uint32_t vehicles;
  std::uint64_t seed;
  double duration_s, foot_mps2, least_km;
};

// No vehicle touches another, no wheel leaves the road, and the foot brakes as a driver's does.
void DriveAFile(const std::string& name, const std::vector<RealDrive>& runs) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  const auto file = std::find_if(files.begin(), files.end(), [&](const auto& path) { return path.stem() == name; });
  ASSERT_NE(file, files.end()) << name;
  const auto world = road::World::Load(*file);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  for (const RealDrive& run : runs) {
    StudySettings settings;
    settings.traffic = Full(run.vehicles);
    settings.traffic.seed = run.seed;
    settings.duration_s = run.duration_s;
    const StudyResult r = RunStudy(settings, world.value()).value();
    const std::string what = fmt::format("{} cars, seed {}", run.vehicles, run.seed);
    EXPECT_EQ(r.collisions, 0) << what;
    EXPECT_EQ(r.off_lane, 0) << what;
    EXPECT_EQ(r.wheels_off, 0) << what;
    EXPECT_LT(r.max_deceleration_mps2, run.foot_mps2) << what;
    EXPECT_GT(r.driven_km, run.least_km) << what;
    testing::Test::RecordProperty(
        what,
        fmt::format("{:.2f} m/s² with a foot on the brake, {:.2f} asked by it, {:.2f} in all, {} steps in an "
                    "emergency, {:.1f} km",
                    r.max_deceleration_mps2, r.foot_mps2, r.max_deceleration_any_mps2, r.hurried_steps, r.driven_km));
  }
}

// Lanes here turn on a radius of 2.9 m, which no van can drive, beside oncoming traffic. The foot brakes by 4 m/s² at
// most, in two minutes of a hundred cars by 4.5; what does not hold is in docs/explanation/traffic.md.
TEST(FullDrive, DrivesARealTown) {
  const std::vector<RealDrive> brief{{60, 1, 20.0, 4.0, 6.0}, {100, 11, 15.0, 4.5, 5.0}},
      long_form{
          {60, 1, 50.0, 4.0, 10.0}, {60, 11, 50.0, 4.0, 10.0}, {100, 1, 120.0, 4.5, 10.0}, {100, 11, 120.0, 4.5, 10.0}};
  DriveAFile("carla_Town04", BriefOrLong(brief, long_form));
}

// Lorries and buses among them, which cannot pass one another in its bends: no vehicle stands in the way of a vehicle
// that stands in its. (Two did from 30 s on.)
TEST(FullDrive, LongBodiesGoOnInARealTown) {
  const auto file = lanes::RealFolder() / "carla_Town04.xodr";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the real files are not beside the project";
  StudySettings settings;
  settings.traffic = Full(100);
  settings.traffic.mix.shares = {0.6, 0.1, 0.2, 0.1};
  settings.duration_s = BriefOrLong(75.0, 120.0);
  const StudyResult r = RunStudy(settings, opendrive::LoadNetwork(file).value()).value();
  std::string what =
      fmt::format("{:.1f} km, {:.1f} s at rest with room ahead, {} wheels off, {:.2f} m/s² with a foot on the brake",
                  r.driven_km, r.longest_with_room_s, r.wheels_off, r.max_deceleration_mps2);
  RecordProperty("drive", what);
  for (const std::string& incident : r.incidents) what += "\n  " + incident;
  EXPECT_EQ(r.collisions, 0) << what;
  EXPECT_EQ(r.off_lane, 0) << what;
  EXPECT_EQ(r.hurried_steps, 0) << what;
  EXPECT_LT(r.longest_with_room_s, BriefOrLong(40.0, 75.0)) << what;
}

// A vehicle that has waited long for room at a merge keeps it, and one that is kept out for that counts as waiting for
// it, so that a chain of them that closes is opened: here the room was missing since those that stood there waited, one
// for another, for the one that was kept out (123.6 s to the end of this drive, and 643 s of a quarter of an hour; 76.1
// s since). That begins after 256 s, in the long form; Circle.AVehicleKeptOutForOneThatWaitsForRoomWaitsForIt asks for
// the same of four cars.
TEST(FullDrive, AVehicleKeptOutForOneThatWaitsForRoomWaitsForIt) {
  if (!IsLongForm()) GTEST_SKIP() << "a long form (RODEIRA_LONG_TESTS)";
  const auto file = lanes::RealFolder() / "carla_Town04.xodr";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the real files are not beside the project";
  StudySettings settings;
  settings.traffic = Full(100);
  settings.traffic.seed = 2;
  settings.traffic.mix.shares = {0.6, 0.1, 0.2, 0.1};
  settings.duration_s = 380.0;
  const StudyResult r = RunStudy(settings, opendrive::LoadNetwork(file).value()).value();
  EXPECT_EQ(r.collisions, 0);
  EXPECT_EQ(r.hurried_steps, 0);
  EXPECT_LT(r.longest_with_room_s, 100.0) << "car " << r.longest_with_room_id;
}

// Up to 0.55 rad across, outward in its bend for one direction.
TEST(FullDrive, DrivesOnABank) {
  const std::vector<RealDrive> brief{{25, 1, 25.0, 4.0, 5.0}, {100, 11, 15.0, 4.0, 3.5}},
      long_form{{25, 1, 60.0, 4.0, 10.0},
                {25, 2, 60.0, 4.0, 10.0},
                {25, 3, 60.0, 4.0, 10.0},
                {25, 4, 60.0, 4.0, 10.0},
                {100, 11, 60.0, 4.0, 10.0}};
  DriveAFile("esmini_straight_500_superelevation_elevation_curve", BriefOrLong(brief, long_form));
}

}  // namespace
}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
// Digests of short runs over maps, physics, threads, seeds and demand, pinned: a refactoring keeps them. A change of
// behaviour brings the new digests and a line in docs/changelog.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/traffic/with_crossings.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kLookEvery_s = 0.5;  // of the run; the poses of these moments are part of the digest

// What a run has beside its vehicles.
enum class With {
  kNothing,
  kPeople,    // a crossing for people on foot on every road, 300 people an hour each
  kFlows,     // vehicles by flows at every entry instead of a fixed number
  kRoute,     // a flow with a route that needs a lane change
  kUnequal,   // drivers whose speeds differ much, so that they overtake
  kMotors,    // the driver of MOTORS
  kCar,       // a driver's car that drives through the middle of the map, then stands
  kCommands,  // a scenario's commands, one vehicle that appears, and one that is hit
  kRestore,   // saved and restored into another model half-way
};

struct PinnedRun {
  const char* map;  // of configs/maps; "NAME.yaml": of configs/worlds; "ring", "exit": of this folder's tests
  std::uint32_t vehicles;
  std::uint64_t seed;
  std::uint32_t threads;
  Physics physics;
  double step_s, run_s;
  With with;
  const char* digest;
};

void PrintTo(const PinnedRun& run, std::ostream* out) {
  *out << run.map << " with " << run.vehicles << " vehicles, seed " << run.seed << ", " << run.threads << " threads";
}

std::shared_ptr<const network::Network> NetworkFor(const std::string& map) {
  if (map == "ring") return Ring(300.0);
  if (map == "exit") return Exit(500.0);
  if (map.ends_with(".yaml")) {
    const auto world = road::World::Load(SourceDir() + "/configs/worlds/" + map);
    EXPECT_TRUE(world.ok()) << world.error().Text();
    return NetworkOf(world.value());
  }
  return lanes::MapNetwork(map);
}

TrafficSettings SettingsFor(const PinnedRun& run) {
  TrafficSettings settings;
  if (run.with == With::kFlows)
    settings = Settings("flows:\n  - {vehicles_per_h: 2400}\n  - {vehicles_per_h: 600, mix: {lorry: 1}}\n");
  if (run.with == With::kRoute) {
    settings = Settings(
        "routes: {off: ['1', '3']}\n"
        "flows:\n  - {lane: '1:-1', route: off, vehicles_per_h: 600}\n  - {lane: '1:-2', vehicles_per_h: 600}\n");
  }
  if (run.with == With::kPeople) settings.pedestrians = PedestrianSettings{.per_h = 300.0, .at = {}, .place = {}};
  if (run.with == With::kUnequal) settings.speed_factor_low = 0.5, settings.variety = 0.3;
  if (run.with == With::kMotors) settings.driver = DriverKind::kMotors;
  if (run.with == With::kCommands) settings.scripted = {VehicleKind::kCar, VehicleKind::kLorry};
  settings.vehicles = run.vehicles;
  settings.seed = run.seed;
  settings.threads = run.threads;
  settings.physics = run.physics;
  return settings;
}

TrafficModel MakeModel(const PinnedRun& run) {
  auto network = NetworkFor(run.map);
  if (run.with == With::kPeople) network = WithCrossings(*network);
  auto model = TrafficModel::Make(SettingsFor(run), network, {});
  EXPECT_TRUE(model.ok()) << model.error().Text();
  return std::move(model).value();
}

// Drives along the first track for 10 s, at 8 m/s, and stands then.
std::vector<driver::Footprint> CarAt(const TrafficModel& model, double time_s) {
  const double d = std::min(8.0 * std::min(time_s, 10.0), model.graph()[0].length_m());
  const lanes::CurvePoint at = model.graph()[0].curve.At(d);
  driver::Footprint car;
  car.id = 4000;
  car.x_m = at.p_W.x(), car.y_m = at.p_W.y();
  car.heading_rad = std::atan2(at.ahead_W.y(), at.ahead_W.x());
  car.speed_mps = time_s < 10.0 ? 8.0 : 0.0;
  car.length_m = 4.4, car.width_m = 1.8;
  return {car};
}

void Command(TrafficModel& model, std::int64_t step) {
  if (step == 50) model.Brake(1, 2.0);
  if (step == 100) model.CapSpeed(2, 5.0);
  if (step == 150) model.CommandOvertake(3);
  if (step == 200) model.CommandLaneChange(4, +1), model.CommandLaneChange(5, -1);
  if (step == 300) model.Release(1);
  if (step == 250) {
    const network::Road& road = model.graph().network().roads()[0];
    const std::string lane = road.id() + ":" + std::to_string(model.graph()[0].lane.lane);
    const auto told = model.Spawn(static_cast<std::uint32_t>(model.vehicles() - 2), lane, 30.0, 8.0);
    EXPECT_TRUE(told.ok()) << told.error().Text();
  }
  if (step == 400 && !model.poses().empty()) {
    const AgentPose& pose = model.poses().front();
    model.Strike(pose.id, {4000.0, 1500.0}, pose.p_WB_W.head<2>());
  }
}

base::Digest DigestOfRun(const PinnedRun& run) {
  TrafficModel model = MakeModel(run);
  base::Digest digest = 0;
  const auto steps = std::llround(run.run_s / run.step_s), every = std::llround(kLookEvery_s / run.step_s);
  for (std::int64_t step = 0; step < steps; ++step) {
    if (run.with == With::kCommands) Command(model, step);
    if (run.with == With::kRestore && step == steps / 2) {
      base::StateWriter writer;
      model.Save(writer);
      TrafficModel other = MakeModel(run);
      base::StateReader reader(writer.bytes());
      other.Restore(reader);
      EXPECT_TRUE(reader.Finish().ok());
      model = std::move(other);
    }
    const double time_s = static_cast<double>(step) * run.step_s;
    model.Step(run.step_s, run.with == With::kCar ? CarAt(model, time_s) : std::vector<driver::Footprint>());
    if (step % every != 0) continue;
    base::StateWriter writer;
    for (const AgentPose& pose : model.poses()) {
      writer.Put("id", pose.id);
      for (int i = 0; i < 3; ++i) writer.Put("p", pose.p_WB_W[i]);
      for (int i = 0; i < 4; ++i) writer.Put("q", pose.q_WB.coeffs()[i]);
      writer.Put("speed", pose.speed_mps);
      writer.Put("acceleration", pose.acceleration_mps2);
      writer.Put("steer", pose.steer_rad);
      writer.Put("lights", model.LightsOf(pose));
      writer.Put("lane", pose.lane);
      writer.Put("gap", model.GapAhead(pose.id));
    }
    digest = base::Combine(digest, writer.digest());
  }
  return base::Combine(digest, DigestOf(model));
}

class PinnedTrafficRuns : public ::testing::TestWithParam<PinnedRun> {};

TEST_P(PinnedTrafficRuns, KeepTheirDigest) { EXPECT_EQ(base::Hex(DigestOfRun(GetParam())), GetParam().digest); }

constexpr Physics kPlanar = Physics::kPlanar, kFull = Physics::kFull;

INSTANTIATE_TEST_SUITE_P(
    Runs, PinnedTrafficRuns,
    ::testing::Values(PinnedRun{"crossing", 24, 1, 1, kPlanar, 0.02, 180.0, With::kNothing, "5a84dd3b7a80f067"},
                      PinnedRun{"roundabout", 30, 2, 1, kPlanar, 0.02, 180.0, With::kNothing, "5343ab0545bd0883"},
                      PinnedRun{"ramp", 40, 3, 1, kPlanar, 0.02, 180.0, With::kNothing, "5edf0e44335ac055"},
                      PinnedRun{"town", 300, 4, 1, kPlanar, 0.05, 180.0, With::kNothing, "e3a1e0bf9d42b58f"},
                      PinnedRun{"town", 300, 4, 2, kPlanar, 0.05, 180.0, With::kNothing, "e3a1e0bf9d42b58f"},
                      PinnedRun{"overpass", 40, 5, 1, kPlanar, 0.02, 120.0, With::kNothing, "2d5eadc97d6fe59c"},
                      PinnedRun{"lights", 90, 6, 1, kPlanar, 0.02, 180.0, With::kNothing, "b6014449c61944ac"},
                      PinnedRun{"lights", 40, 7, 2, kPlanar, 0.1, 270.0, With::kRestore, "5ca1083b6e0aaad6"},
                      PinnedRun{"crossing", 16, 8, 1, kFull, 0.01, 15.0, With::kNothing, "5bed73dada01d446"},
                      PinnedRun{"roundabout", 16, 9, 2, kFull, 0.01, 15.0, With::kRestore, "8fdf68baf950831c"},
                      PinnedRun{"lights", 16, 10, 1, kFull, 0.01, 15.0, With::kPeople, "86689ef753574253"},
                      PinnedRun{"town", 24, 11, 1, kFull, 0.01, 10.0, With::kCar, "3d3c4300fcbca129"},
                      PinnedRun{"crossing", 12, 12, 1, kFull, 0.02, 20.0, With::kMotors, "7167a66b7488cf23"},
                      PinnedRun{"town", 60, 13, 1, kPlanar, 0.05, 180.0, With::kPeople, "3213b66667ca3162"},
                      PinnedRun{"crossing", 60, 14, 1, kPlanar, 0.05, 180.0, With::kFlows, "ae5a9ec730dcbee1"},
                      PinnedRun{"exit", 60, 15, 1, kPlanar, 0.05, 270.0, With::kRoute, "4e3afd58d4c825e3"},
                      PinnedRun{"n222.yaml", 60, 16, 1, kPlanar, 0.05, 270.0, With::kUnequal, "cc6bf426162fa14c"},
                      PinnedRun{"n222.yaml", 40, 17, 1, kPlanar, 0.02, 120.0, With::kCar, "6e4b244c309f3a75"},
                      PinnedRun{"motorway.yaml", 100, 18, 1, kPlanar, 0.05, 180.0, With::kUnequal, "c18509a8532fffff"},
                      PinnedRun{"ramp", 30, 19, 1, kPlanar, 0.02, 120.0, With::kCommands, "29397067762341ff"},
                      PinnedRun{"town", 40, 20, 1, kPlanar, 0.02, 120.0, With::kCommands, "234a7700468def9e"},
                      PinnedRun{"ring", 20, 21, 1, kPlanar, 0.1, 270.0, With::kRestore, "90880442613be2b6"}));

}  // namespace
}  // namespace rodeira::traffic

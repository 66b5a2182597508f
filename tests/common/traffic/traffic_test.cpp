// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/traffic_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "common/driving/driver/idm.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/lane_path.hpp"
#include "tests/n222.hpp"

namespace rodeira::traffic {
namespace {

using driver::Footprint;
using driver::LanePath;

constexpr double kStep_s = 0.01;
using WorldPointer = std::shared_ptr<const road::World>;

TrafficModel Made(const TrafficSettings& settings, WorldPointer world, std::span<const Footprint> others = {}) {
  auto model = TrafficModel::Make(settings, std::move(world), others);
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().Text());
  return std::move(model).value();
}

base::Digest DigestOf(const TrafficModel& model) {
  base::StateWriter writer;
  model.Save(writer);
  return writer.digest();
}

Footprint Car(const LanePath& path, double d, double speed) {
  const driver::LaneFrame frame = path.At(d);
  return {1000, frame.p_W.x(), frame.p_W.y(), frame.heading_rad, speed, 4.0, 1.7};
}

// Gaps from bumper to bumper in each lane, and the speed of the one behind; nearest pairs only.
struct Pair {
  std::uint32_t behind, ahead;
  double gap_m;
};
// The lanes of a road, which must outlive them.
std::map<int, LanePath> PathsOf(const Version1Road& road) {
  std::map<int, LanePath> paths;
  for (const road::Lane& lane : road.lanes()) paths.emplace(lane.id, LanePath(road, lane.id));
  return paths;
}

std::vector<Pair> PairsOf(const TrafficModel& model, const std::map<int, LanePath>& paths) {
  std::map<int, std::vector<std::pair<double, std::uint32_t>>> lanes;
  for (const AgentPose& pose : model.poses()) {
    const auto place = paths.at(pose.lane).Locate(pose.p_WB_W.x(), pose.p_WB_W.y());
    EXPECT_TRUE(place.has_value());
    if (place) lanes[pose.lane].push_back({place->d_m, pose.id});
  }
  std::vector<Pair> pairs;
  for (auto& [lane, cars] : lanes) {
    std::sort(cars.begin(), cars.end());
    for (std::size_t i = 1; i < cars.size(); ++i) {
      const double half = 0.5 * (model.traits(cars[i].second).length_m + model.traits(cars[i - 1].second).length_m);
      pairs.push_back({cars[i - 1].second, cars[i].second, cars[i].first - cars[i - 1].first - half});
    }
  }
  return pairs;
}

// A column behind a leader of constant speed: gaps (s0 + v T) / sqrt(1 - (v/v0)^4), each with the agent's own T and v0.
TEST(Traffic, KeepsTheEquilibriumGapWithin5Centimetres) {
  const road::RoadSpec spec = driver::StraightRoad(9000, 22.0);
  const Version1Road road(spec);
  const WorldPointer world = driver::WorldOf(spec);
  TrafficSettings settings;
  settings.vehicles = 60;
  settings.speed_factor_low = 0.9;
  const LanePath path(road, -1);
  double leader_m = 3000.0;
  std::vector<Footprint> others{Car(path, leader_m, 15.0)};
  TrafficModel model = Made(settings, world, others);
  for (int i = 0; i < 35000; ++i) {
    others[0] = Car(path, leader_m, 15.0);
    model.Step(kStep_s, others);
    leader_m += 15.0 * kStep_s;
  }
  const std::map<int, LanePath> paths = PathsOf(road);
  int compared = 0;
  for (const Pair& pair : PairsOf(model, paths)) {
    const auto find = [&](std::uint32_t id) {
      return *std::find_if(model.poses().begin(), model.poses().end(), [&](const auto& p) { return p.id == id; });
    };
    const AgentPose behind = find(pair.behind);
    if (behind.lane != -1 || std::fabs(behind.speed_mps - 15.0) > 1e-3) continue;
    const AgentTraits& traits = model.traits(pair.behind);
    EXPECT_NEAR(pair.gap_m, driver::IdmEquilibriumGap(traits.idm, 15.0, 22.0 * traits.speed_factor), 0.05)
        << pair.behind;
    ++compared;
  }
  EXPECT_GE(compared, 4);
}

// Ten minutes on N222: the number is conserved, none touches, none is faster than the plan in a bend.
TEST(Traffic, CirculatesOnN222WithoutLossOrCollision) {
  const WorldPointer world = N222();
  TrafficSettings settings;
  settings.vehicles = 60;
  TrafficModel model = Made(settings, world);
  EXPECT_GT(model.on_road(), 50u);
  const std::map<int, LanePath> paths = PathsOf(N222Road());
  double least_gap = 1e9, most_lateral = 0.0, most_over = -1e9, hardest = 0.0;
  for (int i = 0; i < 60000; ++i) {
    model.Step(kStep_s, {});
    ASSERT_EQ(model.on_road() + model.waiting(), 60u);
    if (i % 10 != 0) continue;
    for (const Pair& pair : PairsOf(model, paths)) least_gap = std::min(least_gap, pair.gap_m);
    for (const AgentPose& pose : model.poses()) {
      const LanePath& path = paths.at(pose.lane);
      const auto place = path.Locate(pose.p_WB_W.x(), pose.p_WB_W.y());
      ASSERT_LT(std::fabs(place->offset_m), 0.05);
      most_lateral =
          std::max(most_lateral, pose.speed_mps * pose.speed_mps * std::fabs(path.At(place->d_m).curvature_1pm));
      most_over = std::max(most_over, pose.speed_mps - path.speed_limit_mps());
      hardest = std::max(hardest, -pose.acceleration_mps2);
    }
  }
  EXPECT_GT(least_gap, 1.0);
  EXPECT_LT(most_lateral, 2.4);  // planned 2.0
  EXPECT_LT(most_over, 0.01);
  EXPECT_LT(hardest, 4.0);
  std::uint32_t trips = 0;
  for (const AgentPose& pose : model.poses()) trips += pose.trip;
  EXPECT_GT(trips, 30u);  // they have left and entered again
  EXPECT_GT(model.on_road(), 45u);
}

TEST(Traffic, StandsOnTheGroundOfSuelo) {
  const WorldPointer world = N222();
  TrafficSettings settings;
  TrafficModel model = Made(settings, world);
  const auto ground = world->MakeGround();
  for (int i = 0; i < 3000; ++i) model.Step(kStep_s, {});
  ASSERT_FALSE(model.poses().empty());
  for (const AgentPose& pose : model.poses()) {
    const AgentTraits& traits = model.traits(pose.id);
    for (const double along : {0.5, -0.5}) {
      for (const double across : {0.4, -0.4}) {
        const Eigen::Vector3d foot =
            pose.p_WB_W + pose.q_WB * Eigen::Vector3d(along * traits.wheelbase_m, across * traits.width_m, 0.0);
        const ground::GroundPoint point = ground->At(foot.x(), foot.y(), foot.z());
        ASSERT_TRUE(point.inside);
        EXPECT_NEAR(foot.z(), point.z_m, 0.02) << pose.id;
      }
    }
    const Eigen::Vector3d forward = pose.q_WB * Eigen::Vector3d::UnitX();
    const LanePath path(N222Road(), pose.lane);
    const auto place = path.Locate(pose.p_WB_W.x(), pose.p_WB_W.y());
    EXPECT_NEAR(forward.z() / std::hypot(forward.x(), forward.y()), path.At(place->d_m).grade, 0.005);
  }
}

TEST(Traffic, FollowersStopBehindTheDriversStandingCarAndGoOnAfterwards) {
  const WorldPointer world = N222();
  TrafficSettings settings;
  settings.vehicles = 30;
  const LanePath path(N222Road(), -1);
  const std::vector<Footprint> standing{Car(path, 2500.0, 0.0)};
  TrafficModel model = Made(settings, world, standing);
  double least = 1e9;
  int stopped = 0;
  for (int i = 0; i < 24000; ++i) {
    model.Step(kStep_s, standing);
    stopped = 0;
    for (const AgentPose& pose : model.poses()) {
      if (pose.lane != -1) continue;
      const double d = path.Locate(pose.p_WB_W.x(), pose.p_WB_W.y())->d_m;
      const double gap = 2500.0 - 2.0 - d - 0.5 * model.traits(pose.id).length_m;
      if (gap > -4.0) least = std::min(least, gap);
      if (d < 2500.0 && pose.speed_mps < 0.1) ++stopped;
    }
  }
  EXPECT_GT(least, 1.0);
  EXPECT_LT(least, 3.0);
  EXPECT_GE(stopped, 3);  // a queue
  const std::map<int, LanePath> paths = PathsOf(N222Road());
  for (const Pair& pair : PairsOf(model, paths)) EXPECT_GT(pair.gap_m, 1.0);
  for (int i = 0; i < 6000; ++i) model.Step(kStep_s, {});
  for (const AgentPose& pose : model.poses()) EXPECT_GT(pose.speed_mps, 1.0) << pose.id;
}

TEST(Traffic, TheOtherLaneDoesNotCare) {
  const road::RoadSpec spec = driver::StraightRoad(2000, 20.0);
  const Version1Road road(spec);
  const WorldPointer world = driver::WorldOf(spec);
  const LanePath path(road, -1);
  const std::vector<Footprint> standing{Car(path, 1000.0, 0.0)};
  TrafficSettings settings;
  settings.vehicles = 10;
  TrafficModel model = Made(settings, world, standing);
  int other_lane = 0;
  for (int i = 0; i < 6000; ++i) {
    model.Step(kStep_s, standing);
    for (const AgentPose& pose : model.poses()) {
      ASSERT_GT(pose.speed_mps, pose.lane == 1 ? 10.0 : -1.0);
      other_lane += pose.lane == 1;
    }
  }
  EXPECT_GT(other_lane, 6000);
}

TEST(Traffic, TheSeedAloneDecides) {
  TrafficSettings settings;
  TrafficModel a = Made(settings, N222());
  TrafficModel b = Made(settings, N222());
  settings.seed = 2;
  TrafficModel c = Made(settings, N222());
  EXPECT_NE(DigestOf(a), DigestOf(c));
  EXPECT_NE(a.traits(0).colour_rgb * 1e6 + a.traits(0).idm.time_gap_s,
            c.traits(0).colour_rgb * 1e6 + c.traits(0).idm.time_gap_s);
  for (int i = 0; i < 3000; ++i) {
    a.Step(kStep_s, {});
    b.Step(kStep_s, {});
    ASSERT_EQ(DigestOf(a), DigestOf(b)) << i;
  }
}

TEST(Traffic, RestoredAnywhereItGoesOnWithTheSameBits) {
  TrafficSettings settings;
  settings.vehicles = 40;
  const LanePath path(N222Road(), -1);
  for (const int restore_at : {0, 777, 20000}) {
    TrafficModel a = Made(settings, N222());
    for (int i = 0; i < restore_at; ++i) a.Step(kStep_s, {});
    base::StateWriter writer;
    a.Save(writer);
    TrafficModel b = Made(settings, N222(), std::vector<Footprint>{Car(path, 500.0, 0.0)});
    base::StateReader reader(writer.bytes());
    b.Restore(reader);
    ASSERT_TRUE(reader.Finish().ok());
    for (int i = 0; i < 3000; ++i) {
      const std::vector<Footprint> others{Car(path, 100.0 + 0.1 * i, 10.0)};
      a.Step(kStep_s, others);
      b.Step(kStep_s, others);
    }
    EXPECT_EQ(DigestOf(a), DigestOf(b));
    ASSERT_EQ(a.poses().size(), b.poses().size());
    for (std::size_t k = 0; k < a.poses().size(); ++k) EXPECT_EQ(a.poses()[k].p_WB_W, b.poses()[k].p_WB_W);
  }
}

TEST(Traffic, MoreThanTheRoadHoldsWaitTheirTurn) {
  const road::RoadSpec spec = driver::StraightRoad(300, 15.0);
  const Version1Road road(spec);
  const WorldPointer world = driver::WorldOf(spec);
  TrafficSettings settings;
  settings.vehicles = 200;
  TrafficModel model = Made(settings, world);
  EXPECT_LT(model.on_road(), 120u);
  const std::map<int, LanePath> paths = PathsOf(road);
  double least = 1e9;
  for (int i = 0; i < 12000; ++i) {
    model.Step(kStep_s, {});
    ASSERT_EQ(model.on_road() + model.waiting(), 200u);
    for (const Pair& pair : PairsOf(model, paths)) least = std::min(least, pair.gap_m);
  }
  EXPECT_GT(least, 0.3);
  EXPECT_GT(model.on_road(), 5u);
}

TEST(Traffic, AWorldWithoutLanesIsRefused) {
  road::WorldSpec spec;
  spec.name = "empty";
  spec.plane = road::PlaneSpec{};
  const WorldPointer world = road::World::Make(std::move(spec));
  const auto refused = TrafficModel::Make({}, world, {});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("no lane"), std::string::npos);
  TrafficSettings none;
  none.vehicles = 0;
  EXPECT_TRUE(TrafficModel::Make(none, world, {}).ok());
}

TEST(Traffic, SettingsAreReadAndRefused) {
  auto file =
      config::File::Parse("vehicles: 12\nfollowing: {time_gap_s: 1.2}\ncomfort: {lateral_mps2: 1.5}\n", "t.yaml")
          .value();
  const TrafficSettings settings = ReadTraffic(file.root(), 7);
  EXPECT_TRUE(file.Finish().ok());
  EXPECT_EQ(settings.vehicles, 12u);
  EXPECT_EQ(settings.seed, 7u);
  EXPECT_EQ(settings.idm.time_gap_s, 1.2);
  EXPECT_EQ(settings.physics, Physics::kPlanar);
  auto full = config::File::Parse("physics: full\n", "t.yaml").value();
  EXPECT_EQ(ReadTraffic(full.root(), 7).physics, Physics::kFull);
  auto unknown = config::File::Parse("physics: fully\n", "t.yaml").value();
  (void)ReadTraffic(unknown.root(), 7);
  EXPECT_NE(unknown.Finish().error().Text().find("full"), std::string::npos);
  auto wrong = config::File::Parse("vehicles: -3\n", "t.yaml").value();
  (void)ReadTraffic(wrong.root(), 7);
  EXPECT_FALSE(wrong.Finish().ok());
}

}  // namespace
}  // namespace rodeira::traffic

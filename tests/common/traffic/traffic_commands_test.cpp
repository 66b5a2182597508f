// SPDX-License-Identifier: Apache-2.0
// What a scenario may tell agents.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/driving/driver/test_road.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.01;

TrafficModel Made(std::uint32_t vehicles, double length_m = 2000.0, double limit_mps = 20.0) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.seed = 4;
  auto model = TrafficModel::Make(settings, driver::StraightWorld(length_m, limit_mps), {});
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().Text());
  return std::move(model).value();
}

const AgentPose& PoseOf(const TrafficModel& model, std::uint32_t id) {
  return *std::find_if(model.poses().begin(), model.poses().end(),
                       [id](const AgentPose& pose) { return pose.id == id; });
}

void Pass(TrafficModel& model, double seconds) {
  for (int i = 0; i < std::lround(seconds / kStep_s); ++i) model.Step(kStep_s, {});
}

// From v0 at a to rest: v0 / a seconds, v0² / (2 a) metres.
TEST(TrafficCommands, BrakesAtTheRateGivenToRestAndStays) {
  TrafficModel model = Made(1);
  Pass(model, 10.0);
  const AgentPose before = PoseOf(model, 0);
  ASSERT_GT(before.speed_mps, 15.0);
  model.Brake(0, 4.0);
  double t = 0.0;
  for (; PoseOf(model, 0).speed_mps > 0.0 && t < 20.0; t += kStep_s) {
    EXPECT_NEAR(PoseOf(model, 0).speed_mps, before.speed_mps - 4.0 * t, 1e-9);
    model.Step(kStep_s, {});
  }
  EXPECT_NEAR(t, before.speed_mps / 4.0, kStep_s);
  EXPECT_NEAR((PoseOf(model, 0).p_WB_W - before.p_WB_W).norm(), before.speed_mps * before.speed_mps / 8.0, 1e-6);
  const Eigen::Vector3d rest = PoseOf(model, 0).p_WB_W;
  Pass(model, 5.0);
  EXPECT_EQ((PoseOf(model, 0).p_WB_W - rest).norm(), 0.0);
  model.Release(0);
  Pass(model, 15.0);
  EXPECT_GT(PoseOf(model, 0).speed_mps, 12.0);
}

TEST(TrafficCommands, AFollowerStopsBehind) {
  TrafficModel model = Made(12, 900.0);
  Pass(model, 5.0);
  model.Brake(4, 9.0);
  int pairs = 0;
  for (int i = 0; i < 2500; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& a : model.poses()) {
      for (const AgentPose& b : model.poses()) {
        if (a.id >= b.id || a.lane != b.lane) continue;
        const double room = 0.5 * (model.traits(a.id).length_m + model.traits(b.id).length_m);
        ASSERT_GT((a.p_WB_W - b.p_WB_W).norm(), room) << a.id << " and " << b.id << " at " << i * kStep_s << " s";
        ++pairs;
      }
    }
  }
  EXPECT_GT(pairs, 2500);
}

TEST(TrafficCommands, ACappedAgentIsNeverFasterAndDrivesTheCap) {
  TrafficModel model = Made(1, 4000.0);
  Pass(model, 10.0);
  model.CapSpeed(0, 9.0);
  double before = PoseOf(model, 0).speed_mps;
  for (int i = 0; i < 6000; ++i) {
    model.Step(kStep_s, {});
    const double now = PoseOf(model, 0).speed_mps;
    EXPECT_TRUE(now <= before || now <= 9.0 + 1e-9) << now;
    before = now;
  }
  EXPECT_NEAR(before, 9.0, 0.05);
}

TEST(TrafficCommands, ACommandEndsWhereTheAgentLeavesTheRoad) {
  TrafficModel model = Made(1, 400.0);
  const std::uint32_t trip = PoseOf(model, 0).trip;
  model.CapSpeed(0, 5.0);
  for (int i = 0; i < 30'000 && (model.on_road() == 0 || PoseOf(model, 0).trip == trip); ++i) model.Step(kStep_s, {});
  ASSERT_EQ(model.on_road(), 1u);
  ASSERT_GT(PoseOf(model, 0).trip, trip);
  Pass(model, 5.0);
  EXPECT_GT(PoseOf(model, 0).speed_mps, 10.0);
}

TEST(TrafficCommands, AheadIsInTheOwnLaneAndInFront) {
  TrafficModel model = Made(16, 900.0);
  Pass(model, 2.0);
  const auto footprint = [&](const AgentPose& pose) { return FootprintOf(pose, model.traits(pose.id)); };
  int found = 0;
  for (const AgentPose& own : model.poses()) {
    const Eigen::Vector3d forward = own.q_WB * Eigen::Vector3d::UnitX();
    std::optional<std::uint32_t> expected;
    double nearest = TrafficSettings{}.sight_m;
    for (const AgentPose& other : model.poses()) {
      const double along = (other.p_WB_W - own.p_WB_W).dot(forward);
      if (other.lane != own.lane || along <= 1e-6 || along > nearest) continue;
      nearest = along;
      expected = other.id;
    }
    EXPECT_EQ(model.LeaderOf(footprint(own)), expected) << own.id;
    found += expected ? 1 : 0;
    driver::Footprint turned = footprint(own);
    turned.heading_rad += 3.14159;
    EXPECT_FALSE(model.LeaderOf(turned).has_value()) << "it faces the traffic of its lane";
  }
  EXPECT_GE(found, 10);
}

TEST(TrafficCommands, RestoredInTheMiddleOfACommandItGoesOnWithTheSameBits) {
  TrafficModel model = Made(8);
  Pass(model, 3.0);
  model.Brake(2, 3.0);
  model.CapSpeed(5, 7.0);
  Pass(model, 1.0);
  base::StateWriter out;
  model.Save(out);
  TrafficModel restored = Made(8);
  base::StateReader in(out.bytes());
  restored.Restore(in);
  ASSERT_TRUE(in.Finish().ok());
  for (int i = 0; i < 1000; ++i) {
    model.Step(kStep_s, {});
    restored.Step(kStep_s, {});
    base::StateWriter a, b;
    model.Save(a);
    restored.Save(b);
    ASSERT_EQ(a.digest(), b.digest()) << i;
  }
}

}  // namespace
}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
// Brake lights and indicators of traffic, against what the cars then do.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <string>
#include <vector>

#include "common/traffic/traffic_model.hpp"
#include "common/world/lanes/ring.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.05;
constexpr std::uint32_t kBrake = 1, kLeft = 2, kRight = 4;

// A car at one moment: the track under its middle, where it points, and what its lights say.
struct Instant {
  std::uint32_t trip = 0, track = 0;
  double heading_rad = 0.0, speed_mps = 0.0;
  std::uint32_t lights = 0;
};

std::uint32_t TrackOf(const Agent& agent) {
  std::size_t i = agent.path.size() - 1;
  while (i > 0 && agent.path[i].begin_m > agent.o_m) --i;
  return agent.path[i].track;
}

// Drives a map and tells of each time that a vehicle's middle goes from one track onto another: told(before, after),
// the moments since it entered, oldest first.
template <class Told>
void WatchTracks(const std::string& map, double for_s, const Told& told) {
  TrafficSettings settings;
  settings.vehicles = 25;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork(map), {}).value();
  std::vector<std::deque<Instant>> past(settings.vehicles);
  for (int i = 0; i * kStep_s < for_s; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) {
      const Instant now{pose.trip, TrackOf(model.agent(pose.id)), FootprintOf(pose, model.traits(pose.id)).heading_rad,
                        pose.speed_mps, model.LightsOf(pose)};
      auto& moments = past[pose.id];
      if (!moments.empty() && moments.back().trip != now.trip) moments.clear();
      moments.push_back(now);
      if (moments.size() > 400) moments.pop_front();
      if (moments.size() > 1 && moments[moments.size() - 2].track != now.track) told(model, pose.id, moments);
    }
  }
}

// A vehicle that turns by more than 30° at a branch has indicated to that side, and to no other, for two seconds before
// it reaches it and until half way round; a vehicle that goes straight on has not.
TEST(CarLights, ACarThatTurnsIndicatesToThatSide) {
  for (const char* map : {"crossing", "town", "lights"}) {
    int left = 0, right = 0, straight = 0;
    WatchTracks(map, 150.0, [&](const TrafficModel& model, std::uint32_t id, const std::deque<Instant>& moments) {
      const std::uint32_t on = moments[moments.size() - 2].track;  // which it leaves now
      std::size_t first = moments.size() - 1;
      while (first > 0 && moments[first - 1].track == on) --first;
      if (first < 40) return;  // too early to tell
      const std::uint32_t before = moments[first - 1].track;
      const auto& graph = model.graph();
      if (graph[before].next.size() < 2 || graph[on].length_m() > 60.0 || lanes::OnRing(graph, on) ||
          lanes::OnRing(graph, before))
        return;
      const double turned =
          std::remainder(moments.back().heading_rad - moments[first - 1].heading_rad, 2.0 * std::numbers::pi);
      const std::uint32_t says = std::fabs(turned) < 0.2 ? 0 : turned > 0.0 ? kLeft : kRight;
      if (std::fabs(turned) >= 0.2 && std::fabs(turned) < 0.55) return;
      (says == 0 ? straight : says == kLeft ? left : right) += 1;
      for (std::size_t k = first - 40; k < first + (moments.size() - first) / 2; ++k) {
        if (k < first && moments[k].track != before) continue;  // still in the last turn
        ASSERT_EQ(moments[k].lights & (kLeft | kRight), says)
            << map << ", car " << id << ", " << (static_cast<double>(k) - static_cast<double>(first)) * kStep_s << " s";
      }
    });
    EXPECT_GT(left, 3) << map;
    EXPECT_GT(right, 3) << map;
    EXPECT_GT(straight, 3) << map;
  }
}

// Round a roundabout no vehicle indicates but one that leaves it at the next exit, to the outside, from before it does.
TEST(CarLights, ACarThatLeavesARoundaboutIndicates) {
  int leaves = 0, stays = 0, enters = 0;
  WatchTracks("roundabout", 200.0,
              [&](const TrafficModel& model, std::uint32_t id, const std::deque<Instant>& moments) {
                const auto& graph = model.graph();
                const Instant &before = moments[moments.size() - 2], &now = moments.back();
                const bool from_ring = lanes::OnRing(graph, before.track), to_ring = lanes::OnRing(graph, now.track);
                if (!from_ring && to_ring) {
                  EXPECT_EQ(before.lights & (kLeft | kRight), 0u) << "car " << id << " enters";
                  ++enters;
                }
                if (!from_ring || graph[before.track].next.size() < 2) return;
                ++(to_ring ? stays : leaves);
                for (std::size_t k = moments.size() - 1;
                     k-- > 0 && k + 11 > moments.size() && lanes::OnRing(graph, moments[k].track);) {
                  EXPECT_EQ(moments[k].lights & (kLeft | kRight), to_ring ? 0u : kRight)
                      << "car " << id << (to_ring ? " stays" : " leaves");
                }
              });
  EXPECT_GT(leaves, 10);
  EXPECT_GT(stays, 10);
  EXPECT_GT(enters, 10);
}

// On two lanes around a circle: a vehicle that goes over from one to the other indicates to that side from the first
// hand's breadth on, and no other does.
TEST(CarLights, ACarThatChangesLanesIndicatesToThatSide) {
  constexpr double kRadius_m = 500.0, kAbout_m = 0.15;
  opendrive::RoadText road = CircleRoad(2.0 * std::numbers::pi * kRadius_m);
  road.left = "";
  road.right = CircleLane(-1, 30.0, Mark("broken")) + CircleLane(-2, 30.0, Mark("solid"));
  TrafficSettings settings;
  settings.vehicles = 60;
  settings.speed_factor_low = 0.5;
  TrafficModel model = TrafficModel::Make(settings, opendrive::MustRead(opendrive::Document(road.Text())), {}).value();
  std::vector<double> before(settings.vehicles, 0.0);
  int over = 0;
  for (int i = 0; i < 2400; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) {
      const double out =
          std::hypot(pose.p_WB_W.x(), pose.p_WB_W.y() - kRadius_m) - kRadius_m;  // to the right of the axis
      const double moved = out - before[pose.id];
      before[pose.id] = out;
      if (i == 0) continue;
      const double aside = std::min(std::fabs(out - 1.75), std::fabs(out - 5.25));
      const std::uint32_t says = model.LightsOf(pose) & (kLeft | kRight);
      if (aside > kAbout_m) {
        EXPECT_EQ(says, moved > 0.0 ? kRight : kLeft) << "car " << pose.id << " at " << out << " m";
        ++over;
      } else if (model.agent(pose.id).change.side == 0) {
        EXPECT_EQ(says, 0u) << pose.id;
      }
    }
  }
  EXPECT_GT(over, 200);
}

// Brake lights burn while a vehicle brakes harder than a lifted foot does, until it stands and as long as it does, and
// never while it gains speed.
TEST(CarLights, BrakeLightsBurnFromTheFootToTheStand) {
  TrafficSettings settings;
  settings.vehicles = 25;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("lights"), {}).value();
  std::vector<double> speeds(settings.vehicles, 0.0);
  int standing = 0, braking = 0, driving = 0;
  for (int i = 0; i < 2400; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) {
      const double before = std::exchange(speeds[pose.id], pose.speed_mps), a = (pose.speed_mps - before) / kStep_s;
      if (i == 0 || pose.trip != 0) continue;
      const bool lit = (model.LightsOf(pose) & kBrake) != 0;
      if (pose.speed_mps == 0.0 && before == 0.0) {
        EXPECT_TRUE(lit) << pose.id;
        ++standing;
      } else if (a > 1e-6) {
        EXPECT_FALSE(lit) << pose.id << " " << a;
        ++driving;
      } else if (a < -0.7 || (a < -0.2 && pose.speed_mps < 0.1)) {
        EXPECT_TRUE(lit) << pose.id << " at " << pose.speed_mps << " m/s, " << a << " m/s2";
        ++braking;
      }
    }
  }
  EXPECT_GT(standing, 1000);
  EXPECT_GT(braking, 300);
  EXPECT_GT(driving, 1000);
}

}  // namespace
}  // namespace rodeira::traffic

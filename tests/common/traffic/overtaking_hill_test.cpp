// SPDX-License-Identifier: Apache-2.0
// Overtaking on a road with marks of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <utility>

#include "common/traffic/network/road_network.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/world/road/world.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic {
namespace {

// N222 with lorries' pace before them: passes happen, and only where the world file's middle line is dashed.
TEST(Overtaking, OnTheHillRoadOnlyWhereTheMiddleIsDashed) {
  const auto file = std::filesystem::path(SourceDir()) / "configs/worlds/n222.yaml";
  const auto world = road::World::Load(file);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  std::set<std::pair<int, int>> dashed;
  std::ifstream in(file);
  const std::regex line(R"(\{t_m: 0, .*from_s_m: (\d+), to_s_m: (\d+), kind: dashed)");
  std::smatch found;
  for (std::string text; std::getline(in, text);) {
    if (std::regex_search(text, found, line)) dashed.insert({std::stoi(found[1]), std::stoi(found[2])});
  }
  ASSERT_GE(dashed.size(), 15u);
  const auto legal = [&](double s_m) {
    return std::any_of(dashed.begin(), dashed.end(),
                       [&](const auto& d) { return s_m >= d.first - 0.5 && s_m <= d.second + 0.5; });
  };
  TrafficSettings settings;
  settings.vehicles = 14;
  settings.seed = 3;
  settings.speed_factor_low = 0.9;
  TrafficModel model = TrafficModel::Make(settings, NetworkOf(world.value()), {}).value();
  int over = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> overtakers;
  for (int i = 0; i < 20 * 900; ++i) {
    for (std::uint32_t id = 0; id < 14; id += 4) model.CapSpeed(id, 6.0);
    model.Step(0.05, {});
    for (const AgentPose& pose : model.poses()) {
      const driver::Footprint body = FootprintOf(pose, model.traits(pose.id));
      for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
          const double c = std::cos(body.heading_rad), s = std::sin(body.heading_rad);
          const Eigen::Vector2d corner(body.x_m + x * body.length_m * c - y * body.width_m * s,
                                       body.y_m + x * body.length_m * s + y * body.width_m * c);
          for (const lanes::Graph::Beside& beside : model.graph().TracksAt(corner, 5.0)) {
            const lanes::Track& track = model.graph()[beside.track];
            if (track.lane.lane != pose.lane || beside.foot.d_m <= 0.0 || beside.foot.d_m >= track.length_m()) continue;
            if (beside.foot.offset_m < 0.5 * track.curve.WidthAt(beside.foot.d_m)) continue;
            ++over, overtakers.insert({pose.id, pose.trip});
            EXPECT_TRUE(legal(track.curve.StationAt(beside.foot.d_m)))
                << "car " << pose.id << " at " << i * 0.05 << " s, s " << track.curve.StationAt(beside.foot.d_m);
          }
        }
      }
    }
    for (std::size_t a = 0; i % 4 == 0 && a < model.poses().size(); ++a) {
      for (std::size_t b = a + 1; b < model.poses().size(); ++b) {
        ASSERT_FALSE(driver::Overlap(FootprintOf(model.poses()[a], model.traits(model.poses()[a].id)),
                                     FootprintOf(model.poses()[b], model.traits(model.poses()[b].id))))
            << i * 0.05;
      }
    }
  }
  EXPECT_GT(over, 0);
  EXPECT_GE(overtakers.size(), 4u);
}

}  // namespace
}  // namespace rodeira::traffic

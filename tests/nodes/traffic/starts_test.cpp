// SPDX-License-Identifier: Apache-2.0
// Traffic does not begin where a driver's car begins at a place of its own, but may begin on the lane beside.
#include "nodes/traffic/starts.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/traffic/traffic_model.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kX_m = -150.0, kY_m = -1.6;  // on the lane to the east, the oncoming lane beside it
constexpr std::uint64_t kSeeds = 30;

launch::Launch LaunchWith(const std::string& start) {
  const std::string text = fmt::format(
      "rodeira: launch/1\nworld: ../configs/worlds/lights.yaml\nnodes:\n  road: {{kind: road}}\n  driver: {{kind: "
      "input, config: {{source: script}}}}\n  ego: {{kind: vehicle, config: {{{}}}}}\n  traffic: {{kind: traffic}}\n",
      start);
  auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/starts.yaml");
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
  return std::move(launch).value();
}

class StartOfItsOwn : public testing::Test {
 protected:
  std::vector<driver::Footprint> Clear(const std::string& start) const {
    return ClearAtStart(LaunchWith(start), *world_);
  }
  // How many vehicles of 40, over all seeds, begin less than this from the car, on its lane or on the one beside.
  int Count(const std::vector<driver::Footprint>& clear, double near_m, bool on_lane_beside) const {
    int count = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      traffic::TrafficSettings settings;
      settings.vehicles = 40;
      settings.seed = seed;
      const auto model = traffic::TrafficModel::Make(settings, world_, clear).value();
      for (const traffic::AgentPose& pose : model.poses()) {
        const double across = pose.p_WB_W.y() - kY_m;
        if (std::fabs(pose.p_WB_W.x() - kX_m) < near_m && (on_lane_beside ? across > 2.0 : std::fabs(across) < 1.0) &&
            std::fabs(across) < 5.0)
          ++count;
      }
    }
    return count;
  }

  std::shared_ptr<const road::World> world_ = road::World::Load(SourceDir() + "/configs/worlds/lights.yaml").value();
};

TEST_F(StartOfItsOwn, KeepsItsLaneClear) {
  constexpr double kKept_m = 20.0;
  EXPECT_GT(Count(Clear(""), kKept_m, false), 0);  // without it vehicles begin there
  EXPECT_EQ(Count(Clear("start: {x_m: -150, y_m: -1.6, heading_deg: 0}"), kKept_m, false), 0);
}

TEST_F(StartOfItsOwn, DoesNotForbidTheLaneBeside) {
  const auto without = Clear(""), with = Clear("start: {x_m: -150, y_m: -1.6, heading_deg: 0}");
  EXPECT_GT(Count(with, 10.0, true), 0);
  EXPECT_EQ(Count(with, 10.0, true), Count(without, 10.0, true));
}

TEST_F(StartOfItsOwn, IsReadWithItsSpeed) {
  const auto clear = Clear("start: {x_m: 10, y_m: 20, heading_deg: 90, speed_mps: 12}");
  ASSERT_EQ(clear.size(), 2u);
  EXPECT_EQ(clear[1].x_m, 10.0);
  EXPECT_EQ(clear[1].y_m, 20.0);
  EXPECT_DOUBLE_EQ(clear[1].heading_rad, std::acos(0.0));
  EXPECT_EQ(clear[1].speed_mps, 12.0);
  EXPECT_EQ(Clear("start: {x_m: here, y_m: 20}").size(), 1u);
}

}  // namespace
}  // namespace rodeira::nodes

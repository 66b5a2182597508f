// SPDX-License-Identifier: Apache-2.0
// The maps in configs/maps: nothing is wrong with them, they come back to the byte, and every way leads to an end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/map_plot.hpp"
#include "common/world/traffic_map/map_report.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic_map {
namespace {

const std::filesystem::path kMaps = std::filesystem::path(SourceDir()) / "configs/maps";

class OwnMap : public testing::TestWithParam<const char*> {
 protected:
  const std::filesystem::path path_ = kMaps / (std::string(GetParam()) + ".motors");
};

TEST_P(OwnMap, NothingIsWrong) {
  const auto file = LoadMap(path_);
  ASSERT_TRUE(file.ok()) << file.error().Text();
  const auto heights = LoadHeightsOf(path_);
  ASSERT_TRUE(heights.ok()) << heights.error().Text();
  const auto findings = CheckMap(file.value(), heights.value());
  EXPECT_TRUE(findings.empty()) << findings.front().Text();
  EXPECT_THAT(DescribeMap(file.value(), heights.value(), findings), testing::HasSubstr("0 errors, 0 warnings"));
}

TEST_P(OwnMap, ComesBackToTheByte) {
  const std::string bytes = base::ReadText(path_).value();
  MapFile file = LoadMap(path_).value();
  EXPECT_EQ(WriteMap(file), bytes);
  for (auto& line : file.curves) line.text.clear();
  for (auto& line : file.lanes) line.text.clear();
  for (auto& line : file.connections) line.text.clear();
  EXPECT_EQ(WriteMap(file), bytes);  // the script writes numbers as the editor does
}

TEST_P(OwnMap, LanesMeetAndNoneIsTooSharpForACar) {
  const auto map = LoadLaneMap(path_);
  ASSERT_TRUE(map.ok()) << map.error().Text();
  ASSERT_FALSE(map.value().connections.empty());
  for (const MapConnection& connection : map.value().connections) {
    const LanePoint end = map.value().lanes[connection.from].shape.AtParameter(1.0);
    const LanePoint begin = map.value().lanes[connection.to].shape.AtParameter(0.0);
    EXPECT_LT((end.p_W - begin.p_W).norm(), 0.002);
    EXPECT_GT(end.tangent_W.dot(begin.tangent_W), std::cos(0.002));
    EXPECT_NEAR(end.width_m(), begin.width_m(), 0.005);
    EXPECT_NEAR(end.z_m, begin.z_m, 1e-9);
  }
  for (const MapLane& lane : map.value().lanes) {
    for (int i = 0; i <= 40; ++i)
      EXPECT_LT(std::abs(lane.shape.AtParameter(i / 40.0).curvature_1pm), 1.0 / 6.0) << lane.id;
  }
}

TEST_P(OwnMap, IsDrawn) {
  const std::string svg = PlotMap(LoadLaneMap(path_).value());
  EXPECT_THAT(svg, testing::StartsWith("<svg"));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  EXPECT_THAT(svg, testing::Not(testing::AnyOf(testing::HasSubstr("nan"), testing::HasSubstr("inf\""))));
}

INSTANTIATE_TEST_SUITE_P(Maps, OwnMap, testing::Values("crossing", "roundabout", "ramp", "town", "overpass", "lights"),
                         [](const auto& made) { return made.param; });

struct Passed {
  std::size_t lane;
  LanePoint at;
};

// Lanes that cross do so with room for a lorry between them, and there are such crossings.
TEST(Overpass, IsAnOverpass) {
  const LaneMap map = LoadLaneMap(kMaps / "overpass.motors").value();
  std::vector<Passed> low, high;
  for (std::size_t i = 0; i < map.lanes.size(); ++i) {
    const LaneShape& shape = map.lanes[i].shape;
    for (double s = 0.0; s < shape.length_m(); s += 1.0) {
      const LanePoint at = shape.At(s);
      (at.z_m > 0.5 ? high : low).push_back({i, at});
    }
  }
  int over = 0;
  for (const Passed& above : high) {
    for (const Passed& below : low) {
      if ((above.at.p_W - below.at.p_W).norm() > 0.8 || std::abs(above.at.tangent_W.dot(below.at.tangent_W)) > 0.5)
        continue;
      EXPECT_GT(above.at.z_m - below.at.z_m, 5.0) << map.lanes[above.lane].id << " over " << map.lanes[below.lane].id;
      ++over;
    }
  }
  EXPECT_GE(over, 4);  // two lanes over two
}

}  // namespace
}  // namespace rodeira::traffic_map

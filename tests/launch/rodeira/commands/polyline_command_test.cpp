// SPDX-License-Identifier: Apache-2.0
// `rodeira polyline` on the axes of worlds' roads.
#include "launch/rodeira/commands/polyline_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/core/geometry/polyline.hpp"
#include "common/world/road/world.hpp"
#include "launch/rodeira/commands/world_axis.hpp"
#include "tests/n222.hpp"
#include "tests/names.hpp"

namespace rodeira::cli {
namespace {

const std::string kWorlds = SourceDir() + "/configs/worlds/";

TEST(WorldAxis, IsNamedByFileAndRoad) {
  EXPECT_EQ(AxisNameOf("a b/n222.yaml#n222")->file, "a b/n222.yaml");
  EXPECT_EQ(AxisNameOf("town#1.xodr#12")->road, "12");
  for (const char* other : {"points.csv", "points#1.csv", "n222.yaml", "n222.yaml#", "#n222"})
    EXPECT_FALSE(AxisNameOf(other)) << other;
}

// The axis is where the world has it, from its beginning to its end, at its height.
TEST(WorldAxis, LiesOnTheRoad) {
  for (const std::string& file :
       {kWorlds + "n222.yaml", SourceDir() + "/tests/data/n222_version1.yaml", kWorlds + "motorway.yaml"}) {
    const auto world = road::World::Load(file).value();
    const network::Road& road = world->network()->roads()[0];
    const auto line = AxisOf({file, road.id()}, 5.0);
    ASSERT_TRUE(line.ok()) << line.error().Text();
    const double length_m = road.length_m();
    EXPECT_EQ(line.value().points_W.size(), static_cast<std::size_t>(std::ceil(length_m / 5.0 - 1e-9)) + 1);
    EXPECT_NEAR(geometry::StationsOf(line.value()).back(), length_m, 2e-3 * length_m) << "chords are shorter";
    if (road.id() != "n222") continue;
    for (std::size_t i = 0; i < line.value().points_W.size(); i += 37) {
      const auto at = N222Road().Locate(line.value().points_W[i].x(), line.value().points_W[i].y());
      ASSERT_TRUE(at);
      EXPECT_NEAR(at->t_m, 0.0, 1e-6);
      EXPECT_NEAR(at->s_m, std::min(5.0 * static_cast<double>(i), length_m), 1e-6);
      EXPECT_NEAR(line.value().points_W[i].z(), N222Road().Evaluate(at->s_m).p_W.z(), 1e-6);
    }
  }
}

// HASTE's main road is cut by six junctions: whole again it is as long as its author drew it, and nowhere farther from
// one point to the next than a step.
TEST(WorldAxis, OfARoadThatJunctionsCutIsWhole) {
  const auto line = AxisOf({kWorlds + "haste.yaml", "main"}, 5.0);
  ASSERT_TRUE(line.ok()) << line.error().Text();
  EXPECT_NEAR(geometry::StationsOf(line.value()).back(), 30443.044, 5.0)
      << "chords are shorter, and it goes up and down";
  const auto& points_W = line.value().points_W;
  for (std::size_t i = 1; i < points_W.size(); ++i)
    ASSERT_LE((points_W[i] - points_W[i - 1]).head<2>().norm(), 5.0 + 1e-6) << i;
  EXPECT_THAT(AxisOf({kWorlds + "haste.yaml", "mian"}, 5.0).error().Text(), Names("road 'mian' … 'main'"));
}

TEST(Polylines, MoveAnAxisAndRefuseARoadThatIsNotThere) {
  auto folder = base::TemporaryFolder::Make("axis");
  ASSERT_TRUE(folder.ok());
  const auto out = folder.value().path() / "moved.csv";
  PolylineOptions options;
  options.command = "translate";
  options.files = {kWorlds + "n222.yaml#n222"};
  options.out = out.string();
  options.by_m = {100.0, -50.0};
  ASSERT_EQ(Polylines(options), 0);
  const auto moved = geometry::ReadPolyline(base::ReadText(out).value(), out.string());
  ASSERT_TRUE(moved.ok()) << moved.error().Text();
  const auto axis = AxisOf({kWorlds + "n222.yaml", "n222"}, 1.0).value();
  ASSERT_EQ(moved.value().points_W.size(), axis.points_W.size());
  EXPECT_NEAR((moved.value().points_W[500] - axis.points_W[500] - Eigen::Vector3d(100.0, -50.0, 0.0)).norm(), 0.0,
              1e-5);
  options.files = {kWorlds + "n222.yaml#n22"};
  EXPECT_EQ(Polylines(options), 2);
  EXPECT_THAT(AxisOf({kWorlds + "n222.yaml", "n22"}, 1.0).error().Text(), Names("road 'n22' … 'n222'"));
  EXPECT_FALSE(AxisOf({kWorlds + "n223.yaml", "n222"}, 1.0).ok());
}

}  // namespace
}  // namespace rodeira::cli

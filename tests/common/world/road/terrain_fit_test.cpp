// SPDX-License-Identifier: Apache-2.0
// Roads of version 2 lie on their terrain: where one leaves it, file, line and station are said.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"

namespace rodeira::road {
namespace {

using testing::HasSubstr;

// To the north from (200.03, 60.5), 5.75 m wide on both sides.
std::string RoadOn(const std::string& terrain, double length_m, const std::string& keys = "") {
  return "rodeira: world/2\nname: w\nterrain: " + terrain +
         "\nroads:\n  - id: a\n    start: {x_m: 200.03, y_m: 60.5, heading_deg: 90}\n    axis: [line: {length_m: " +
         std::to_string(length_m) + "}]\n" + keys + "    section: {template: rural}\n";
}

std::string ProblemOf(const std::string& text) {
  const auto world = World::Parse(text, "made.yaml");
  return world.ok() ? "none" : world.error().Text();
}

// 0 to 400 m both ways.
constexpr const char* kHills =
    "{generate: {seed: 3, columns: 41, rows: 41, spacing_m: 10, west_m: 0, south_m: 0, relief: [{wavelength_m: 90, "
    "amplitude_m: 3}]}}";

TEST(TerrainFit, HillsEndWhereTheirGridDoes) {
  EXPECT_EQ(ProblemOf(RoadOn(kHills, 339.4)), "none");
  EXPECT_EQ(ProblemOf(RoadOn(kHills, 360.0)),
            "made.yaml:7: road 'a' leaves the terrain at s = 340 m: its left edge lies at (194.3, 400.5)");
  EXPECT_EQ(ProblemOf(RoadOn(kHills, 360.0, "    bridges: [{from_s_m: 320, to_s_m: 360}]\n")), "none");
  std::string beside = RoadOn(kHills, 100.0);
  beside.replace(beside.find("x_m: 200.03"), 11, "x_m: 5.48");  // the axis is on it, its left edge is not
  EXPECT_THAT(ProblemOf(beside),
              HasSubstr("made.yaml:7: road 'a' leaves the terrain at s = 0 m: its left edge lies at (-0.3, 60.5)"));
  beside.replace(beside.find("x_m: 5.48"), 9, "x_m: 394.52");
  EXPECT_THAT(ProblemOf(beside), HasSubstr("its right edge lies at (400.3, 60.5)"));
}

// Heights in the middle of pixels of 10 m from 0 to 400 m, so the ground goes from 5 to 395; none in those from 180 to
// 220 east, 250 to 270 north.
TEST(TerrainFit, AVoidOfAnElevationFileIsNoTerrain) {
  const cli::TemporaryFolder folder;
  std::string heights = "ncols 40\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n";
  for (int row = 39; row >= 0; --row) {  // from north to south
    for (int column = 0; column < 40; ++column)
      heights += column >= 18 && column < 22 && (row == 25 || row == 26) ? "-9999 " : "7.5 ";
    heights += "\n";
  }
  folder.Write("land.asc", heights);
  const auto problem = [&](double length_m, const std::string& keys) {
    const auto problems = WorldProblems(folder.Write("w.yaml", RoadOn("{file: land.asc}", length_m, keys)));
    return problems.empty() ? std::string("none") : problems.front().Text();
  };
  EXPECT_EQ(problem(180.0, ""), "none");  // to 240.5 m
  const std::string place = (folder.path() / "w.yaml").string() + ":7: ";
  // The cell from 245 to 255 m has heights on one side only, so it is no ground: from s = 184.5 m on.
  EXPECT_THAT(problem(280.0, ""), Names(place + " … 'a' … s = 185 m … left … (194.3, 245.5)"));
  EXPECT_EQ(problem(280.0, "    bridges: [{from_s_m: 183.5, to_s_m: 216}]\n"), "none");
  EXPECT_THAT(problem(340.0, "    bridges: [{from_s_m: 183.5, to_s_m: 216}]\n"),
              Names(place + " … 'a' … s = 335 m … left … (194.3, 395.5)"));
}

// Heights in a ring about a void, and no start: the car stands on the ground nearest to the middle.
TEST(TerrainFit, WithoutAStartTheCarStandsOnTheNearestGround) {
  const cli::TemporaryFolder folder;
  std::string heights = "ncols 30\nnrows 30\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -1\n";
  for (int row = 29; row >= 0; --row) {
    for (int column = 0; column < 30; ++column)
      heights += column > 4 && column < 23 && row > 4 && row < 25 ? "-1 " : "3.25 ";
    heights += "\n";
  }
  folder.Write("ring.asc", heights);
  const auto world = World::Load(folder.Write("w.yaml", "rodeira: world/2\nname: w\nterrain: {file: ring.asc}\n"));
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const StartPose start = world.value()->start();
  EXPECT_NEAR(world.value()->At(start.x_m, start.y_m).z_m, 3.25, 1e-6);
  // The middle is (250, 350); the void ends in the east at the posts of column 23, at x = 335.
  EXPECT_NEAR(std::hypot(start.x_m - 250.0, start.y_m - 350.0), 90.0, 8.0);
  const auto named = World::Load(
      folder.Write("n.yaml", "rodeira: world/2\nname: w\nterrain: {file: ring.asc}\nstart: {x_m: 250, y_m: 350}\n"));
  ASSERT_FALSE(named.ok());
  EXPECT_THAT(named.error().Text(), HasSubstr("n.yaml:4: the start (250, 350) lies where the elevation file has no "
                                              "height; the nearest place with ground is ("));
  const auto outside = World::Load(
      folder.Write("o.yaml", "rodeira: world/2\nname: w\nterrain: {file: ring.asc}\nstart: {x_m: 50, y_m: 350}\n"));
  EXPECT_THAT(outside.error().Text(), HasSubstr("o.yaml:4: the start (50, 350) lies outside the terrain"));
}

// A plane that climbs by 10 % to the north on Web Mercator's metres: at 60 degrees north, where a metre is two there,
// the ground climbs by 20 % (1.9984 along a meridian, by the formulas of the ellipsoid in EPSG guidance note 7-2). A
// road that is said in the map's coordinates lies in the same place of the ground, and is as long as it says.
TEST(TerrainFit, WhatLiesOnAWebMercatorTerrainMovesWithIt) {
  const cli::TemporaryFolder folder;
  // Around 10.5 degrees east, 60 degrees north.
  constexpr double kWest = 1'168'000.0, kSouth = 8'398'500.0, kCell = 40.0;
  std::string heights =
      fmt::format("ncols 80\nnrows 80\nxllcorner {}\nyllcorner {}\ncellsize {}\n", kWest, kSouth, kCell);
  for (int row = 79; row >= 0; --row) {
    for (int column = 0; column < 80; ++column) heights += fmt::format("{} ", 0.1 * kCell * (row + 0.5));
    heights += "\n";
  }
  folder.Write("m.asc", heights);
  folder.Write("m.prj",
               "PROJCS[\"WGS_1984_Web_Mercator_Auxiliary_Sphere\",GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\","
               "SPHEROID[\"WGS_1984\",6378137.0,298.257223563]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\","
               "0.0174532925199433]],PROJECTION[\"Mercator_Auxiliary_Sphere\"],PARAMETER[\"False_Easting\",0.0],"
               "PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\",0.0],PARAMETER["
               "\"Standard_Parallel_1\",0.0],PARAMETER[\"Auxiliary_Sphere_Type\",0.0],UNIT[\"Meter\",1.0]]");
  const std::string file = folder.Write(
      "w.yaml",
      fmt::format("rodeira: world/2\nname: w\nterrain: {{file: m.asc}}\nroads:\n  - id: a\n    start: {{x_m: {}, "
                  "y_m: {}, heading_deg: 90}}\n    axis: [line: {{length_m: 400}}]\n    section: {{template: "
                  "rural}}\n",
                  kWest + 1600.0, kSouth + 1000.0));
  const auto world = World::Load(file);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  EXPECT_THAT(WorldWarnings(file), testing::Contains(HasSubstr("a metre on the ground is 1.99")));
  const network::Road& road = world.value()->network()->roads()[0];
  EXPECT_EQ(road.length_m(), 400.0);
  const Eigen::Vector2d from = road.axis().Evaluate(0.0).p_W, to = road.axis().Evaluate(400.0).p_W;
  // The bare ground beside the road, 100 m to the east of either end.
  const Eigen::Vector2d east = 100.0 * Eigen::Vector2d((to - from).y(), -(to - from).x()).normalized();
  const double low = world.value()->grid()->At((from + east).x(), (from + east).y()).z_m,
               high = world.value()->grid()->At((to + east).x(), (to + east).y()).z_m;
  EXPECT_NEAR(low, 100.0, 0.1);
  EXPECT_NEAR((high - low) / 400.0, 0.19984 / 0.99969, 2e-5);  // by the scale of UTM there
  EXPECT_THAT(world.value()->grid()->projection_wkt(), HasSubstr("UTM_Zone_32N"));
}

}  // namespace
}  // namespace rodeira::road

// SPDX-License-Identifier: Apache-2.0
// Roads of version 2 lie on their terrain: where one leaves it, file, line and station are said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

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
  EXPECT_EQ(problem(280.0, ""),
            place + "road 'a' leaves the terrain at s = 185 m: its left edge lies at (194.3, 245.5)");
  EXPECT_EQ(problem(280.0, "    bridges: [{from_s_m: 183.5, to_s_m: 216}]\n"), "none");
  EXPECT_EQ(problem(340.0, "    bridges: [{from_s_m: 183.5, to_s_m: 216}]\n"),
            place + "road 'a' leaves the terrain at s = 335 m: its left edge lies at (194.3, 395.5)");
}

}  // namespace
}  // namespace rodeira::road

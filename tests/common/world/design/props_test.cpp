// SPDX-License-Identifier: Apache-2.0
// What stands at no road, as a world file names it: where each thing stands, computed by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "common/core/geometry/angle.hpp"
#include "tests/common/world/design/made_roads.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::design {
namespace {

using testing::HasSubstr;

std::string With(const std::string& objects) { return "rodeira: world/2\nobjects:\n" + objects; }

TEST(Props, OneThingStandsWhereItIsSaid) {
  const Design design =
      SoundDesign(With("  - {type: house, name: mill, x_m: 120.5, y_m: -30, heading_deg: 30, length_m: 14, width_m: 8, "
                       "height_m: 6, z_m: 0.25}\n  - {type: tree, x_m: 1, y_m: 2, height_m: 10}\n"));
  ASSERT_EQ(design.props.placements.size(), 2u);
  EXPECT_EQ(design.network, nullptr);
  const auto& building = design.props.placements[0];
  EXPECT_EQ(building.at_W, Eigen::Vector2d(120.5, -30.0));
  EXPECT_NEAR(building.heading_rad, geometry::kPi / 6.0, 1e-12);
  const network::Object& mill = design.props.objects[building.object];
  EXPECT_TRUE(mill.name == "mill" && mill.type == "building" && mill.subtype == "house" && mill.z_offset_m == 0.25);
  EXPECT_TRUE(mill.length_m == 14.0 && mill.width_m == 8.0 && mill.height_m == 6.0);
  const network::Object& tree = design.props.objects[design.props.placements[1].object];
  EXPECT_NEAR(tree.radius_m, 3.0, 1e-12);
  EXPECT_EQ(design.props.placements[1].heading_rad, 0.0);
}

// 30 m to the east, then 40 to the north: every 20 m from its beginning on there is one at 0, 20, 40 and 60 m, the last
// two beyond the corner.
TEST(Props, ARowFollowsItsLine) {
  const Design design =
      SoundDesign(With("  - {type: lamp, along: [[100, 50], [130, 50], [130, 90]], every_m: 20, rotation_deg: 90}\n"));
  ASSERT_EQ(design.props.placements.size(), 4u);
  const std::array<Eigen::Vector2d, 4> places = {Eigen::Vector2d(100.0, 50.0), Eigen::Vector2d(120.0, 50.0),
                                                 Eigen::Vector2d(130.0, 60.0), Eigen::Vector2d(130.0, 80.0)};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((design.props.placements[i].at_W - places[i]).norm(), 0.0, 1e-12) << i;
    EXPECT_NEAR(design.props.placements[i].heading_rad, (i < 2 ? 0.5 : 1.0) * geometry::kPi, 1e-12) << i;
  }
  // A whole number of times: one stands at the very end.
  EXPECT_EQ(SoundDesign(With("  - {type: tree, along: [[0, 0], [0, 30]], every_m: 0.1}\n")).props.placements.size(),
            301u);
}

TEST(Props, WallsAndRailsGoOnAlongTheirLine) {
  const Design design =
      SoundDesign(With("  - {type: wall, along: [[0, 0], [10, 0], [10, 10]], height_m: 2}\n  - {type: guard_rail, "
                       "along: [[0, 5], [9, 5]]}\n"));
  EXPECT_TRUE(design.props.placements.empty());
  ASSERT_EQ(design.props.runs.size(), 2u);
  EXPECT_EQ(design.props.runs[0].points_W.size(), 3u);
  EXPECT_EQ(design.props.runs[0].points_W[2], Eigen::Vector2d(10.0, 10.0));
  EXPECT_EQ(design.props.objects[design.props.runs[1].object].height_m, 0.75);
}

TEST(Props, BesideRoadsToo) {
  const Design design = SoundDesign(
      "rodeira: world/2\nroads:\n  - {id: a, axis: [line: {length_m: 50}], section: {template: rural}}\nobjects: "
      "[{type: bush, x_m: 20, y_m: 30}]\n");
  EXPECT_EQ(design.network->roads().size(), 1u);
  EXPECT_EQ(design.props.placements.size(), 1u);
}

TEST(Props, WhatDoesNotFitIsASentence) {
  EXPECT_THAT(FirstProblem(With("  - {type: treee, x_m: 1, y_m: 2}\n")),
              HasSubstr("made.yaml:3: 'objects[0].type' is 'treee'"));
  EXPECT_THAT(FirstProblem(With("  - {type: tree, x_m: 1}\n")), HasSubstr("y_m"));
  EXPECT_THAT(FirstProblem(With("  - {type: tree, x_m: 1, y_m: 2, s_m: 3}\n")),
              HasSubstr("unknown key 'objects[0].s_m'"));
  EXPECT_THAT(FirstProblem(With("  - {type: tree, x_m: 1, y_m: 2, every_m: 3}\n")),
              HasSubstr("what is repeated stands 'along' a line"));
  EXPECT_THAT(FirstProblem(With("  - {type: tree, along: [[0, 0], [9, 0]], every_m: 3, heading_deg: 3}\n")),
              HasSubstr("what stands 'along' a line has no 'heading_deg' of its own"));
  EXPECT_THAT(FirstProblem(With("  - {type: wall, x_m: 1, y_m: 2}\n")), HasSubstr("has no 'x_m' of its own"));
  EXPECT_THAT(FirstProblem(With("  - {type: wall, along: [[1, 2]]}\n")),
              HasSubstr("'along' has 1 points; two or more were expected"));
  EXPECT_THAT(FirstProblem(With("  - {type: wall, along: [[1, 2], [3]]}\n")),
              HasSubstr("a point of 'along' is [x, y]"));
  EXPECT_THAT(FirstProblem(With("  - {type: wall, along: [[1, 2], [1, 2]]}\n")),
              HasSubstr("this point of 'along' is the one before"));
  EXPECT_THAT(FirstProblem(With("  - {type: wall, along: [[0, 0], [200000, 0]]}\n")),
              HasSubstr("'along' is 200000 m long; at most 100000 m was expected"));
  EXPECT_THAT(FirstProblem(With("  - {type: tree, along: [[0, 0], [20000, 0]], every_m: 0.1}\n")),
              HasSubstr("more than 100 000 in a row"));
  EXPECT_THAT(FirstProblem(With("  - {type: house, x_m: 1, y_m: 2, model: none.osgb}\n")),
              HasSubstr("there is no model file"));
}

// A model is found from wherever the program stands: its name is a whole path, at roads too.
TEST(Props, AModelIsNamedByItsWholePath) {
  const cli::TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  folder.Write("hut.obj", "v 0 0 0\n");
  std::filesystem::current_path(folder.path());
  const Design design = SoundDesign(
      "rodeira: world/2\nobjects: [{type: house, x_m: 1, y_m: 2, model: hut.obj}]\nroads:\n  - {id: a, axis: [line: "
      "{length_m: 50}], section: {template: rural},\n"
      "     objects: [{type: house, s_m: 3, model: hut.obj}]}\n");
  std::filesystem::current_path(before);
  EXPECT_EQ(design.props.objects[0].name, (folder.path() / "hut.obj").string());
  EXPECT_EQ(design.network->roads()[0].spec().objects[0].name, (folder.path() / "hut.obj").string());
}

}  // namespace
}  // namespace rodeira::design

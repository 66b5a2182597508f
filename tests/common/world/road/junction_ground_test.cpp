// SPDX-License-Identifier: Apache-2.0
// A file's junction with a boundary and heights of its own (OpenDRIVE 1.8): SUELO on it, and what of it is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::road {
namespace {

using opendrive::Document;
using opendrive::RoadText;
using testing::HasSubstr;

double Height(double x, double y) {
  return 2.0 + 0.03 * x - 0.02 * y + 0.002 * x * y + 0.0004 * x * x * x - 0.0003 * y * y * y;
}

// A T: roads 1 and 2 from the west and the east, road 4 from the south; road 3 goes through from 1 to 2, road 6 from 1
// to 4; roads 7 and 8 cut the corners of the boundary. The ways through say another height than the grid.
struct Tee {
  std::string transition;
  std::string west_joint =
      R"(<segment type="joint" roadId="1" contactPoint="end" jointLaneStart="1" jointLaneEnd="-1" )";
  std::string plan = R"(<planView><geometry s="0" x="-16" y="0" hdg="0" length="32"><line/></geometry></planView>)";
  std::string type;
  int rows = 9;

  static RoadText Straight(const char* id, double x, double y, double heading, double length) {
    RoadText road;
    road.id = id;
    road.length = length;
    road.geometry = fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\"><line/></geometry>", x, y,
                                heading, length);
    return road;
  }
  std::string Text() const {
    RoadText west = Straight("1", -50, 0, 0, 40), east = Straight("2", 10, 0, 0, 40),
             through = Straight("3", -10, 0, 0, 20), south = Straight("4", 0, -10, -M_PI_2, 40);
    RoadText turn = Straight("6", -10, 0, 0, 10.0 * M_PI_2),
             corner_1 = Straight("7", -10, -3.5, -M_PI_4, 6.5 * M_SQRT2),
             corner_2 = Straight("8", 3.5, -10, M_PI_4, 6.5 * M_SQRT2);
    west.elevation = "<elevation s=\"0\" a=\"2\" b=\"0.01\" c=\"0\" d=\"0\"/>";
    west.link = "<successor elementType=\"junction\" elementId=\"5\"/>";
    for (RoadText* road : {&east, &south}) road->link = "<predecessor elementType=\"junction\" elementId=\"5\"/>";
    through.left +=
        R"(<lane id="2" type="sidewalk"><width sOffset="0" a="0.4" b="0" c="0" d="0"/>
            <height sOffset="0" inner="0.12" outer="0.12"/></lane>)";
    through.link =
        R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>
            <successor elementType="road" elementId="2" contactPoint="start"/>)";
    turn.geometry =
        fmt::format("<geometry s=\"0\" x=\"-10\" y=\"0\" hdg=\"0\" length=\"{}\"><arc curvature=\"-0.1\"/></geometry>",
                    10.0 * M_PI_2);
    turn.link =
        R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>
            <successor elementType="road" elementId="4" contactPoint="start"/>)";
    for (RoadText* road : {&through, &turn, &corner_1, &corner_2}) {
      road->attributes = "junction=\"5\"";
      road->elevation = "<elevation s=\"0\" a=\"9\" b=\"0\" c=\"0\" d=\"0\"/>";
    }
    for (RoadText* road : {&turn, &corner_1, &corner_2}) road->left = "";
    for (RoadText* road : {&corner_1, &corner_2}) road->right = "";
    std::string grid;
    for (int row = 0; row < rows; ++row) {
      const double x = -16.0 + 4.0 * row;
      grid += fmt::format("<elevation center=\"{}\" left=\"{} {}\" right=\"{} {} {} {}\"/>\n", Height(x, 0),
                          Height(x, 4), Height(x, 8), Height(x, -4), Height(x, -8), Height(x, -12), Height(x, -16));
    }
    return Document(
        west.Text() + east.Text() + through.Text() + south.Text() + turn.Text() + corner_1.Text() + corner_2.Text() +
        "<junction id=\"5\" " + type + ">" +
        R"(<connection id="0" incomingRoad="1" connectingRoad="3" contactPoint="start"><laneLink from="-1" to="-1"/>
            </connection>
                       <connection id="1" incomingRoad="1" connectingRoad="6" contactPoint="start">
                         <laneLink from="-1" to="-1"/></connection>
                       <boundary><segment type="joint" roadId="2" contactPoint="start" jointLaneStart="-1"
                         jointLaneEnd="1"/>
                       <segment type="lane" roadId="3" boundaryLane="1" sStart="end" sEnd="begin"/>)" +
        west_joint + transition + "/>\n" +
        R"(<segment type="lane" roadId="7" boundaryLane="0" sStart="begin" sEnd="end"/>
            <segment type="joint" roadId="4" contactPoint="start"/>
                       <segment type="lane" roadId="8" boundaryLane="0" sStart="0" sEnd="end"/></boundary>)" +
        plan + "<elevationGrid sStart=\"0\" gridSpacing=\"4\">\n" + grid + "</elevationGrid></junction>\n");
  }
};

std::shared_ptr<const World> MustLoad(const cli::TemporaryFolder& folder, const std::string& text) {
  const auto world = World::Load(folder.Write("tee.xodr", text));
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.ok() ? world.value() : nullptr;
}

// Whether (x, y) lies within the boundary.
bool Inside(double x, double y) { return std::fabs(x) < 10.0 && y > -10.0 && y < 3.5 && y > std::fabs(x) - 13.5; }

TEST(JunctionGround, IsTheGridsOnTheWaysThroughAndBetweenThem) {
  const cli::TemporaryFolder folder;
  const auto world = MustLoad(folder, Tee().Text());
  ASSERT_NE(world, nullptr);
  int between = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const double x = base::RandomUniform({i, 1}, -10.0, 10.0), y = base::RandomUniform({i, 2}, -10.0, 3.5);
    if (!Inside(x, y)) continue;
    const SurfacePoint at = world->At(x, y);
    EXPECT_NEAR(at.z_m, Height(x, y), 1e-10) << x << " " << y;
    EXPECT_NEAR(at.slope_x, 0.03 + 0.002 * y + 0.0012 * x * x, 1e-9);
    EXPECT_NEAR(at.slope_y, -0.02 + 0.002 * x - 0.0009 * y * y, 1e-9);
    EXPECT_EQ(at.surface, ground::Surface::kAsphalt);
    std::vector<network::Surfacing> surfaces;
    world->network()->Surfaces(x, y, surfaces);
    between += surfaces.empty();
  }
  EXPECT_GT(between, 300);
  // The network's lanes are as high; a lane's own height stands on it.
  const network::LaneKey lane{*world->network()->FindRoad("6"), 0, -1};
  const Eigen::Vector3d middle = world->network()->Centre(lane, 7.0);
  EXPECT_NEAR(middle.z(), Height(middle.x(), middle.y()), 1e-10);
  EXPECT_NEAR(world->At(2.0, 3.7).z_m, Height(2.0, 3.7) + 0.12, 1e-10);
}

TEST(JunctionGround, ARoadGoesOverIntoItWithoutStepOrKink) {
  const cli::TemporaryFolder folder;
  Tee tee;
  tee.transition = "transitionLength=\"3\"";
  const auto world = MustLoad(folder, tee.Text());
  ASSERT_NE(world, nullptr);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double y = base::RandomUniform({i, 1}, -3.4, 3.4);
    const SurfacePoint road = world->At(-10.0 - 1e-7, y), in = world->At(-10.0 + 1e-7, y);
    EXPECT_NEAR(road.z_m, 2.4, 1e-6);
    EXPECT_NEAR(in.z_m, 2.4, 1e-6) << y;
    EXPECT_NEAR(in.slope_x, 0.01, 1e-5);
    // The third corner lies 3 m along the cut corner, the fourth 3 m along the way through.
    const double part = (3.5 - y) / 7.0, end_x = -7.0 + part * (3.0 * M_SQRT1_2 - 3.0),
                 end_y = 3.5 + part * (-3.5 - 3.0 * M_SQRT1_2 - 3.5);
    const double z = Height(end_x, end_y);
    EXPECT_NEAR(world->At(end_x + 1e-7, end_y).z_m, z, 1e-6);
    EXPECT_NEAR(world->At(end_x - 1e-7, end_y).z_m, z, 1e-6) << y;
  }
  // On the straight side of the piece: the cubic by heights and slopes at both ends.
  const double to = Height(-7.0, 3.5), rise = 3.0 * (0.03 + 0.002 * 3.5 + 0.0012 * 49.0);
  const double l = 0.4, expected = 2.4 + 0.03 * l + (3.0 * (to - 2.4) - 0.06 - rise) * l * l +
                                   (0.03 + rise - 2.0 * (to - 2.4)) * l * l * l;
  EXPECT_NEAR(world->At(-10.0 + 3.0 * l, 3.5 - 1e-9).z_m, expected, 1e-8);
}

TEST(JunctionGround, WhatBreaksARuleIsNamed) {
  const auto first = [](const Tee& tee) {
    const auto import = opendrive::Read(tee.Text(), "tee.xodr", opendrive::Tolerance::Unrepaired());
    return import.value().errors.empty() ? "" : import.value().errors.front().Text();
  };
  EXPECT_EQ(first({}), "");
  Tee tee;
  tee.rows = 6;
  EXPECT_THAT(
      first(tee),
      HasSubstr("junctions.elevation_grid.valid_for_entire_boundry: junction 5: its heights do not reach to (10.00, "));
  tee.rows = 1;
  EXPECT_THAT(first(tee), HasSubstr("junctions.elevation_grid.squares: junction 5"));
  tee = {};
  tee.plan = "";
  EXPECT_THAT(first(tee), HasSubstr("junctions.elevation_grid.perpendicular_vectors: the junction has heights across a "
                                    "reference line, but no <planView>"));
  tee = {};
  tee.type = "type=\"direct\"";
  EXPECT_THAT(first(tee), HasSubstr("junctions.boundary.only_for_common_junctions: junction 5: its type is 'direct'"));
  tee = {};
  tee.west_joint = R"(<segment type="joint" roadId="1" contactPoint="start" )";
  EXPECT_THAT(first(tee), HasSubstr("junctions.boundary.segments_close_boundry: junction 5: a gap of 40.6"));
  tee.west_joint = R"(<segment type="joint" roadId="99" contactPoint="end" )";
  EXPECT_THAT(
      first(tee),
      HasSubstr("junctions.boundary.road: junction 5: its boundary names the road '99', which is not in the file"));
  tee.west_joint = R"(<segment type="joint" roadId="1" contactPoint="end" jointLaneStart="4" )";
  EXPECT_THAT(first(tee), HasSubstr("junctions.boundary.lane: junction 5: its boundary names lane 4 of road 1"));
}

}  // namespace
}  // namespace rodeira::road

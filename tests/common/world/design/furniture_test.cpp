// SPDX-License-Identifier: Apache-2.0
// Signs, objects, structures and speed limits of a world file, and what roads go on into, against what their keys say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "common/world/network/placing.hpp"
#include "tests/common/world/design/made_roads.hpp"

namespace rodeira::design {
namespace {

using testing::HasSubstr;

// A straight road to the east, 3 m of lane and 1 m of verge on the right, 3.5 m and as much on the left.
std::string RoadWith(const std::string& keys, const std::string& section = "") {
  return "rodeira: world/2\nroads:\n  - id: a\n    axis: [line: {length_m: 100}]\n    z_m: 0\n    section: {lanes: "
         "[{id: -1, width_m: 3}, {id: 1, width_m: 3.5}]" +
         section + "}\n" + keys;
}

const network::RoadSpec& SpecOf(const Design& design) { return design.network->roads()[0].spec(); }

// Seen from above, x to the east: the traffic of a sign looks against its face.
double Turned(double heading_rad) { return std::remainder(heading_rad, 2.0 * geometry::kPi); }

TEST(Signs, FaceTheirTraffic) {
  const Design design =
      SoundDesign(RoadWith("    signs:\n      - {type: stop, s_m: 20}\n      - {type: stop, s_m: 30, for: against}\n   "
                           "   - {type: stop, s_m: 40, for: both}\n"
                           "      - {type: stop, s_m: 50, for: along, rotation_deg: 30}\n"));
  const auto& signals = SpecOf(design).signals;
  ASSERT_EQ(signals.size(), 4u);
  EXPECT_EQ(signals[0].orientation, "+");
  EXPECT_EQ(signals[1].orientation, "-");
  EXPECT_EQ(signals[2].orientation, "none");
  const network::Furniture placed = network::PlaceFurniture(*design.network);
  ASSERT_EQ(placed.things.size(), 4u);
  EXPECT_NEAR(std::fabs(Turned(placed.things[0].heading_rad)), geometry::kPi, 1e-12);
  EXPECT_NEAR(Turned(placed.things[1].heading_rad), 0.0, 1e-12);
  EXPECT_TRUE(placed.things[2].both_sides && !placed.things[0].both_sides && !placed.things[1].both_sides);
  EXPECT_NEAR(Turned(placed.things[3].heading_rad), Turned(geometry::kPi + geometry::kPi / 6.0), 1e-12);
  // Each on the side of its readers, 0.3 m within the outermost edge; the other side may be said.
  EXPECT_NEAR(signals[0].t_m, -3.7, 1e-12);
  EXPECT_NEAR(signals[1].t_m, 4.2, 1e-12);
  const Design left = SoundDesign(
      RoadWith("    signs: [{type: stop, s_m: 20, side: left, beside_m: 1.5}, {type: stop, s_m: 20, t_m: -9}]\n"));
  EXPECT_NEAR(SpecOf(left).signals[0].t_m, 6.0, 1e-12);
  EXPECT_EQ(SpecOf(left).signals[1].t_m, -9.0);
}

TEST(Signs, SayTheirTextAndValueInTheirSize) {
  const Design design =
      SoundDesign(RoadWith("    signs: [{type: town, text: Vilar, s_m: 20, height_m: 1.3, z_m: 1.5}, {type: "
                           "speed_limit, value: 70, s_m: 60}]\n"));
  const auto& signals = SpecOf(design).signals;
  ASSERT_EQ(signals.size(), 2u);
  EXPECT_EQ(signals[0].text, "Vilar");
  EXPECT_EQ(signals[0].type, "310");
  EXPECT_EQ(signals[0].height_m, 1.3);
  EXPECT_NEAR(signals[0].width_m, 2.0, 1e-12);  // twice 0.65 x 1
  EXPECT_EQ(signals[0].z_offset_m, 1.5);
  EXPECT_EQ(signals[1].value, 70.0);
  EXPECT_EQ(signals[1].unit, "km/h");
  EXPECT_EQ(signals[1].text, "");
  EXPECT_THAT(FirstProblem(RoadWith("    signs: [{type: stop, value: 3, s_m: 20}]\n")),
              HasSubstr("the sign 'stop' shows no value"));
}

TEST(Objects, AreTurnedRepeatedAndOfTheirSize) {
  const Design design = SoundDesign(
      RoadWith("    objects:\n      - {type: house, name: mill, side: left, beside_m: 15, s_m: 40, rotation_deg: -90, "
               "length_m: 12, width_m: 8, height_m: 6, z_m: 0.5}\n"
               "      - {type: tree, t_m: -14, from_s_m: 10, every_m: 20, to_s_m: 55, height_m: 9, radius_m: 2}\n"
               "      - {type: guard_rail, side: right, from_s_m: 30, to_s_m: 80}\n"));
  const network::Furniture placed = network::PlaceFurniture(*design.network);
  ASSERT_EQ(placed.things.size(), 4u);
  const network::Placed& building = placed.things[0];
  EXPECT_EQ(building.object->name, "mill");
  EXPECT_NEAR(Turned(building.heading_rad), -0.5 * geometry::kPi, 1e-12);
  EXPECT_NEAR(building.t_m, 4.5 + 15.0, 1e-12);
  EXPECT_EQ(building.z_offset_m, 0.5);
  EXPECT_TRUE(building.length_m == 12.0 && building.width_m == 8.0 && building.height_m == 6.0);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_NEAR(placed.things[i].s_m, 10.0 + 20.0 * static_cast<double>(i - 1), 1e-12);
    EXPECT_TRUE(placed.things[i].t_m == -14.0 && placed.things[i].height_m == 9.0 && placed.things[i].radius_m == 2.0);
  }
  ASSERT_EQ(placed.runs.size(), 1u);
  EXPECT_EQ(placed.runs[0].from_s_m, 30.0);
  EXPECT_EQ(placed.runs[0].to_s_m, 80.0);
  EXPECT_NEAR(placed.runs[0].t_start_m, -3.5, 1e-12);  // half a metre within the edge
}

// A lane that widens from 3 to 9 m and back, its edge by 3u^2 - 2u^3: what stands beside it keeps its distance within 5
// cm, at every station, and a row its stations.
TEST(Objects, KeepBesideAnEdgeThatMoves) {
  const Design design = SoundDesign(
      "rodeira: world/2\nroads:\n  - id: a\n    axis: [line: {length_m: 200}]\n    z_m: 0\n"
      "    section: {lanes: [{id: -1, widths: [{s_m: 0, width_m: 3}, {s_m: 60, width_m: 9}, {s_m: 140, width_m: 9}, "
      "{s_m: 200, width_m: 3}]}, {id: 1, width_m: 3}], verge: {width_m: 0}}\n"
      "    objects: [{type: guard_rail, side: right, beside_m: 0.5}, {type: tree, side: right, beside_m: 2, from_s_m: "
      "0, every_m: 10}, {type: tree, side: left, beside_m: 2, from_s_m: 5, every_m: 10}]\n");
  EXPECT_THAT(design.warnings, testing::IsEmpty());
  const auto edge = [](double s) {
    const double u = std::clamp(s < 100.0 ? s / 60.0 : (200.0 - s) / 60.0, 0.0, 1.0);
    return -3.0 - 6.0 * u * u * (3.0 - 2.0 * u);
  };
  const network::Furniture furniture = network::PlaceFurniture(*design.network);
  std::vector<double> right, left;
  for (const network::Placed& placed : furniture.things) {
    (placed.t_m < 0.0 ? right : left).push_back(placed.s_m);
    if (placed.t_m < 0.0)
      EXPECT_NEAR(placed.t_m, edge(placed.s_m) - 2.0, 0.05) << placed.s_m;
    else
      EXPECT_DOUBLE_EQ(placed.t_m, 5.0);
  }
  ASSERT_EQ(right.size(), 21u);
  for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(right[i], 10.0 * static_cast<double>(i), 1e-9);
  EXPECT_EQ(left.size(), 20u);
  double end = 0.0;
  ASSERT_GT(furniture.runs.size(), 4u);
  for (const network::PlacedRun& run : furniture.runs) {
    EXPECT_DOUBLE_EQ(run.from_s_m, end);
    end = run.to_s_m;
    for (int i = 0; i <= 20; ++i) {
      const double s = run.from_s_m + (run.to_s_m - run.from_s_m) * i / 20.0,
                   t = run.t_start_m + (run.t_end_m - run.t_start_m) * i / 20.0;
      EXPECT_NEAR(t, edge(s) - 0.5, 0.055) << s;  // 5 cm at every metre
    }
  }
  EXPECT_DOUBLE_EQ(end, 200.0);
  // Beside a straight edge one repeat says all.
  EXPECT_EQ(design.network->roads()[0].spec().objects[2].repeats.size(), 1u);
}

TEST(Objects, OnLanesThatAreDrivenOnAreWarnings) {
  const auto warnings = [](const std::string& objects) {
    return SoundDesign(
               "rodeira: world/2\nroads:\n  - id: a\n    axis: [line: {length_m: 100}]\n    z_m: 0\n    section: "
               "{template: rural}\n    " +
               objects + "\n")
        .warnings;
  };
  EXPECT_THAT(
      warnings("objects: [{type: house, t_m: 0, s_m: 50}]"),
      testing::ElementsAre(testing::HasSubstr(
          "made.yaml:7: the house of road 'a' at s = 50.0 m, t = 0.00 m stands on lane 1, which is driven on")));
  // The house is 9 m deep: half of it reaches the lane with its edge at 3.5 m.
  EXPECT_THAT(warnings("objects: [{type: house, t_m: 7.9, s_m: 50}]"), testing::SizeIs(1));
  EXPECT_THAT(warnings("objects: [{type: house, t_m: 8.1, s_m: 50}]"), testing::IsEmpty());
  EXPECT_THAT(
      warnings("objects: [{type: tree, side: right, beside_m: -3, from_s_m: 0, every_m: 5}]"),
      testing::ElementsAre(testing::HasSubstr("the tree of road 'a' at s = 0.0 m, t = -2.75 m stands on lane -1")));
  EXPECT_THAT(warnings("objects: [{type: wall, t_m: 3, from_s_m: 20, to_s_m: 30}]"),
              testing::ElementsAre(testing::HasSubstr("the wall of road 'a' at s = 20.0 m")));
  EXPECT_THAT(warnings("signs: [{type: stop, t_m: -3.2, s_m: 20}]"),
              testing::ElementsAre(testing::HasSubstr("the sign 'stop' of road 'a' at s = 20.0 m")));
  EXPECT_THAT(warnings("objects: [{type: post, t_m: -1, s_m: 20}, {type: lamp, t_m: 0, s_m: 20, z_m: 5}]"),
              testing::IsEmpty());
}

TEST(Structures, AreBridgesAndTunnels) {
  const Design design =
      SoundDesign(RoadWith("    bridges: [{from_s_m: 10, to_s_m: 25, name: over the brook}]\n    tunnels: [{from_s_m: "
                           "60, to_s_m: 90, name: through the hill}]\n"));
  const auto& structures = SpecOf(design).structures;
  ASSERT_EQ(structures.size(), 2u);
  EXPECT_TRUE(structures[0].bridge && structures[0].name == "over the brook" && structures[0].s_m == 10.0 &&
              structures[0].length_m == 15.0);
  EXPECT_TRUE(!structures[1].bridge && structures[1].name == "through the hill" && structures[1].s_m == 60.0 &&
              structures[1].length_m == 30.0);
}

// A lane's own limit goes before the road's, the points before the one number.
TEST(SpeedLimits, HoldFromTheirStationOn) {
  const Design design = SoundDesign(
      "rodeira: world/2\nroads:\n  - id: a\n    axis: [line: {length_m: 100}]\n    z_m: 0\n    section: {lanes: [{id: "
      "-1, width_m: 3}, {id: 1, width_m: 3, speed_limit_kmh: 30}]}\n"
      "    speed_limit_kmh: 90\n    speed_limits: [{s_m: 20, speed_kmh: 70}, {s_m: 60, speed_kmh: 50}]\n");
  const network::Road& road = design.network->roads()[0];
  const network::LaneSection& section = road.spec().sections[0];
  for (const auto& [s_m, limit_kmh] : {std::pair(0.0, 90.0), std::pair(19.9, 90.0), std::pair(20.1, 70.0),
                                       std::pair(59.9, 70.0), std::pair(60.1, 50.0), std::pair(100.0, 50.0)}) {
    EXPECT_NEAR(road.SpeedLimitAt(*section.Find(-1), s_m).value(), limit_kmh / 3.6, 1e-12) << s_m;
    EXPECT_NEAR(road.SpeedLimitAt(*section.Find(1), s_m).value(), 30.0 / 3.6, 1e-12) << s_m;
  }
}

// Falls change by 3u^2 - 2u^3 from point to point, outward, and stay as they are before the first one and behind the
// last.
TEST(Crossfalls, GoFromPointToPoint) {
  const Design design = SoundDesign(
      RoadWith("", ", crossfalls: [{s_m: 20, left: 0.02, right: 0.03}, {s_m: 60, left: -0.01, right: 0.05}]"));
  const network::Road& road = design.network->roads()[0];
  for (const auto& [s_m, left, right] :
       {std::tuple(5.0, 0.02, 0.03), std::tuple(30.0, 0.02 - 0.03 * 10.0 / 64.0, 0.03 + 0.02 * 10.0 / 64.0),
        std::tuple(40.0, 0.005, 0.04), std::tuple(80.0, -0.01, 0.05)}) {
    EXPECT_NEAR(road.Surface(s_m, 2.0).p_W.z(), -2.0 * left, 1e-12) << s_m;
    EXPECT_NEAR(road.Surface(s_m, -2.0).p_W.z(), -2.0 * right, 1e-12) << s_m;
  }
}

TEST(Offsets, MoveWhereTheSidesMeet) {
  const Design design = SoundDesign(
      RoadWith("", ", offsets: [{s_m: 20, t_m: 0}, {s_m: 60, t_m: 1}], crossfall: {kind: crown, fall: 0.02}"));
  const network::Road& road = design.network->roads()[0];
  for (const auto& [s_m, t_m] :
       {std::pair(5.0, 0.0), std::pair(30.0, 10.0 / 64.0), std::pair(40.0, 0.5), std::pair(80.0, 1.0)}) {
    EXPECT_NEAR(road.CentreAt(s_m).value, t_m, 1e-12);
    EXPECT_NEAR(road.SpanAt(0, -1, s_m)->outer_t_m, t_m - 3.0, 1e-12);
    EXPECT_NEAR(road.SpanAt(0, 1, s_m)->outer_t_m, t_m + 3.5, 1e-12);
    EXPECT_NEAR(road.Surface(s_m, t_m - 2.0).p_W.z(), -0.04, 1e-12) << "the crown is there too";
  }
}

// A 'predecessor' says what a 'successor' of the other road would: lanes of the same number are joined, both ways.
TEST(GoesOn, FromARoadsBeginningBackIntoAnother) {
  const std::string two =
      "rodeira: world/2\nroads:\n  - id: a\n    axis: [line: {length_m: 100}]\n    z_m: 0\n    section: {template: "
      "rural}\n"
      "  - id: b\n    start: {x_m: 100, y_m: 0}\n    axis: [line: {length_m: 50}]\n    z_m: 0\n    section: {template: "
      "rural}\n    predecessor: {road: a, end: end}\n";
  const Design design = SoundDesign(two);
  const network::Network& network = *design.network;
  ASSERT_EQ(network.roads().size(), 2u);
  const auto& back = network.roads()[1].spec().predecessor;
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->id, "a");
  EXPECT_EQ(back->contact, network::End::kEnd);
  const auto ahead = network.Successors({0, 0, -1}), against = network.Successors({1, 0, 1});
  ASSERT_EQ(ahead.size(), 1u);
  EXPECT_TRUE(ahead[0].lane == (network::LaneKey{1, 0, -1}) && ahead[0].end == network::End::kStart);
  ASSERT_EQ(against.size(), 1u);
  EXPECT_TRUE(against[0].lane == (network::LaneKey{0, 0, 1}) && against[0].end == network::End::kEnd);
  std::string apart = two;
  apart.replace(apart.find("x_m: 100"), 8, "x_m: 101");
  EXPECT_NE(FirstProblem(apart), "none");
}

}  // namespace
}  // namespace rodeira::design

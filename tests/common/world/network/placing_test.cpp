// SPDX-License-Identifier: Apache-2.0
// Where things at roads stand, against circles and counts in closed form.
#include "common/world/network/placing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::network {
namespace {

using opendrive::Document;
using opendrive::MustRead;
using opendrive::RoadText;

constexpr double kRadius_m = 50.0;

// A circle to the left about (10, 70), from its southernmost point.
RoadText Circle() {
  RoadText road;
  road.geometry = R"(<geometry s="0" x="10" y="20" hdg="0" length="100"><arc curvature="0.02"/></geometry>)";
  road.elevation = R"(<elevation s="0" a="5" b="0.03" c="0" d="0"/>)";
  return road;
}

Eigen::Vector3d OnCircle(double s_m, double t_m) {
  const double angle = s_m / kRadius_m;
  return {10.0 + (kRadius_m - t_m) * std::sin(angle), 70.0 - (kRadius_m - t_m) * std::cos(angle), 5.0 + 0.03 * s_m};
}

TEST(Placing, ARowHasItsCountItsSpacingAndItsTaper) {
  RoadText road = Circle();
  road.more =
      R"(<objects><object id="o" type="tree" s="1" t="1" zOffset="9" radius="2" height="3" hdg="0.25">
          <repeat s="10" length="40" distance="7" tStart="6" tEnd="8" zOffsetStart="0" zOffsetEnd="1" heightStart="5"
          heightEnd="9"/></object></objects>)";
  const auto network = MustRead(Document(road.Text()));
  const Furniture furniture = PlaceFurniture(*network);
  EXPECT_TRUE(furniture.runs.empty());
  ASSERT_EQ(furniture.things.size(), 6u);  // 10, 17 … 45: floor(40 / 7) + 1
  for (std::size_t i = 0; i < 6; ++i) {
    const Placed& tree = furniture.things[i];
    const double s = 10.0 + 7.0 * static_cast<double>(i), share = 7.0 * static_cast<double>(i) / 40.0;
    EXPECT_NEAR(tree.s_m, s, 1e-12);
    EXPECT_NEAR(tree.t_m, 6.0 + 2.0 * share, 1e-12);
    EXPECT_NEAR(tree.z_offset_m, share, 1e-12);
    EXPECT_NEAR(tree.height_m, 5.0 + 4.0 * share, 1e-12);
    EXPECT_EQ(tree.radius_m, 2.0);
    EXPECT_NEAR((tree.foot_W - OnCircle(s, tree.t_m)).norm(), 0.0, 1e-10);
    EXPECT_NEAR(tree.heading_rad, s / kRadius_m + 0.25, 1e-12);
  }
}

// On the chord from (s 10, t 6) to (s 50, t -4) of the circle, evenly, heading along it; s and t are those of the
// circle under it.
TEST(Placing, ARowThatLeavesTheRoadsLineStandsOnItsChord) {
  RoadText road = Circle();
  road.more =
      R"(<objects><object id="o" type="tree" s="1" t="1" height="3" hdg="0.25">
          <repeat s="10" length="40" distance="8" tStart="6" tEnd="-4" detachFromReferenceLine="true"/></object>
          </objects>)";
  const auto network = MustRead(Document(road.Text()));
  const Furniture furniture = PlaceFurniture(*network);
  ASSERT_EQ(furniture.things.size(), 6u);
  const Eigen::Vector2d begin = OnCircle(10.0, 6.0).head<2>(), end = OnCircle(50.0, -4.0).head<2>(), way = end - begin;
  for (std::size_t i = 0; i < 6; ++i) {
    const Placed& tree = furniture.things[i];
    const Eigen::Vector2d p = begin + 0.2 * static_cast<double>(i) * way, out = p - Eigen::Vector2d(10.0, 70.0);
    EXPECT_NEAR((tree.foot_W.head<2>() - p).norm(), 0.0, 1e-9) << i;
    EXPECT_NEAR(tree.s_m, kRadius_m * std::atan2(out.x(), -out.y()), 1e-8) << i;
    EXPECT_NEAR(tree.t_m, kRadius_m - out.norm(), 1e-8) << i;
    EXPECT_NEAR(tree.foot_W.z(), 5.0 + 0.03 * tree.s_m, 1e-9);
    EXPECT_NEAR(tree.heading_rad, std::atan2(way.y(), way.x()) + 0.25, 1e-12);
  }
}

TEST(Placing, ARunThatLeavesTheRoadsLineIsItsChord) {
  RoadText road = Circle();
  road.more =
      R"(<objects><object id="o" type="barrier" s="1" t="1" height="1">
          <repeat s="10" length="40" distance="0" tStart="6" tEnd="6" detachFromReferenceLine="true"/></object>
    <object id="q" type="barrier" s="1" t="1" height="1"><repeat s="10" length="40" distance="0" tStart="6" tEnd="6"/>
      </object></objects>)";
  const auto network = MustRead(Document(road.Text()));
  const Furniture furniture = PlaceFurniture(*network);
  ASSERT_EQ(furniture.runs.size(), 2u);
  const Eigen::Vector3d begin = OnCircle(10.0, 6.0), end = OnCircle(50.0, 6.0);
  for (const double share : {0.0, 0.3, 0.5, 1.0}) {
    const PlacedRun::Point straight = furniture.runs[0].At(network->roads()[0], share),
                           bent = furniture.runs[1].At(network->roads()[0], share);
    EXPECT_NEAR((straight.p_W - (begin + share * (end - begin))).norm(), 0.0, 1e-9);
    EXPECT_NEAR(straight.left_W.dot((end - begin).head<2>()), 0.0, 1e-9);
    EXPECT_NEAR((bent.p_W - OnCircle(10.0 + 40.0 * share, 6.0)).norm(), 0.0, 1e-9);
  }
  // Half of 0.8 rad to each side on 44 m: the chord's middle lies 44 (1 - cos 0.4) m nearer to the centre.
  EXPECT_NEAR((furniture.runs[0].At(network->roads()[0], 0.5).p_W - furniture.runs[1].At(network->roads()[0], 0.5).p_W)
                  .head<2>()
                  .norm(),
              44.0 * (1.0 - std::cos(0.4)), 1e-9);
}

TEST(Placing, LengthsAndRadiiTaperAsTheirRepeatSays) {
  RoadText road = Circle();
  road.more =
      R"(<objects><object id="o" type="building" s="1" t="1" length="3" width="2" height="3">
          <repeat s="10" length="40" distance="20" tStart="6" tEnd="6" lengthStart="4" lengthEnd="8"/></object>
    <object id="p" type="tree" s="1" t="1" radius="2" height="3">
      <repeat s="10" length="40" distance="20" tStart="6" tEnd="6" radiusStart="1" radiusEnd="3"/></object>
    <object id="q" type="pole" s="1" t="1" radius="0.2" height="3">
      <repeat s="10" length="40" distance="0" tStart="6" tEnd="6" radiusStart="0.1" radiusEnd="0.3"/></object>
      </objects>)";
  const auto network = MustRead(Document(road.Text()));
  const Furniture furniture = PlaceFurniture(*network);
  ASSERT_EQ(furniture.things.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(furniture.things[i].length_m, 4.0 + 2.0 * static_cast<double>(i), 1e-12);
    EXPECT_EQ(furniture.things[i].width_m, 2.0);
    EXPECT_NEAR(furniture.things[3 + i].radius_m, 1.0 + static_cast<double>(i), 1e-12);
  }
  ASSERT_EQ(furniture.runs.size(), 1u);
  EXPECT_NEAR(furniture.runs[0].width_start_m, 0.2, 1e-12);
  EXPECT_NEAR(furniture.runs[0].width_end_m, 0.6, 1e-12);
}

TEST(Placing, AWholeNumberOfSpacesCountsItsEndAndARoadsEndCutsARow) {
  RoadText road;
  road.more =
      R"(<objects><object id="a" type="pole" s="0" t="5" height="1">
          <repeat s="0" length="0.9" distance="0.3" tStart="5" tEnd="5"/></object>
    <object id="b" type="pole" s="0" t="5" height="1"><repeat s="90" length="40" distance="5" tStart="5" tEnd="5"/>
      </object></objects>)";
  const Furniture furniture = PlaceFurniture(*MustRead(Document(road.Text())));
  ASSERT_EQ(furniture.things.size(), 4u + 3u);  // 0, 0.3, 0.6, 0.9; 90, 95, 100
  EXPECT_NEAR(furniture.things[3].s_m, 0.9, 1e-12);
  EXPECT_EQ(furniture.things[6].s_m, 100.0);
}

TEST(Placing, ARailGoesOnToTheRoadsEndAtMost) {
  RoadText road;
  road.more =
      R"(<objects><object id="a" type="barrier" s="0" t="5" height="0.7" width="0.3">
          <repeat s="60" length="80" distance="0" tStart="4" tEnd="6" zOffsetStart="0" zOffsetEnd="0.8"/></object>
          </objects>)";
  const auto network = MustRead(Document(road.Text()));
  const Furniture furniture = PlaceFurniture(*network);
  EXPECT_TRUE(furniture.things.empty());
  ASSERT_EQ(furniture.runs.size(), 1u);
  const PlacedRun& run = furniture.runs[0];
  EXPECT_EQ(run.from_s_m, 60.0);
  EXPECT_EQ(run.to_s_m, 100.0);
  EXPECT_NEAR(run.t_start_m, 4.0, 1e-12);
  EXPECT_NEAR(run.t_end_m, 5.0, 1e-12);  // half of the way
  EXPECT_NEAR(run.z_end_m, 0.4, 1e-12);
  EXPECT_EQ(run.height_end_m, 0.7);
  EXPECT_EQ(run.width_start_m, 0.3);
}

TEST(Placing, FacesLookAgainstTheTrafficThatTheyAreFor) {
  RoadText road = Circle();
  road.more =
      R"(<signals><signal id="a" s="30" t="-5" zOffset="2" orientation="+" dynamic="no" type="274" subtype="-1"
          country="DE" hOffset="0.1"/>
    <signal id="b" s="30" t="5" zOffset="2" orientation="-" dynamic="no" type="274" subtype="-1" country="DE"
      hOffset="0.1"/>
    <signal id="c" s="30" t="5" zOffset="2" orientation="none" dynamic="no" type="274" subtype="-1" country="DE"/>
      </signals>)";
  const auto network = MustRead(Document(road.Text()));
  const Furniture furniture = PlaceFurniture(*network);
  ASSERT_EQ(furniture.things.size(), 3u);
  const Eigen::Vector2d along(std::cos(30.0 / kRadius_m), std::sin(30.0 / kRadius_m));
  const auto looks = [&](std::size_t i) {
    return Eigen::Vector2d(std::cos(furniture.things[i].heading_rad), std::sin(furniture.things[i].heading_rad));
  };
  EXPECT_NEAR(looks(0).dot(along), -std::cos(0.1), 1e-12);
  EXPECT_NEAR(looks(1).dot(along), std::cos(0.1), 1e-12);
  EXPECT_NEAR(looks(2).dot(along), -1.0, 1e-12);
  EXPECT_FALSE(furniture.things[0].both_sides || furniture.things[1].both_sides);
  EXPECT_TRUE(furniture.things[2].both_sides);
  // Turned by a positive offset: counter-clockwise, whichever way it looks.
  EXPECT_NEAR(-along.x() * looks(0).y() + along.y() * looks(0).x(), std::sin(0.1), 1e-12);
  EXPECT_NEAR(along.x() * looks(1).y() - along.y() * looks(1).x(), std::sin(0.1), 1e-12);
  EXPECT_NEAR((furniture.things[0].foot_W - OnCircle(30.0, -5.0)).norm(), 0.0, 1e-10);
  EXPECT_EQ(furniture.things[0].z_offset_m, 2.0);
}

// A sign counts at its own place, wherever it is seen.
TEST(Placing, ASignIsSeenWhereItSays) {
  RoadText road = Circle(), other;
  other.id = "2";
  other.geometry = R"(<geometry s="0" x="500" y="0" hdg="1.5707963267948966" length="100"><line/></geometry>)";
  road.more =
      R"(<signals><signal id="a" s="30" t="-5" zOffset="2" orientation="+" dynamic="no" type="206" subtype="-1"
          country="DE"><positionRoad roadId="2" s="40" t="-6" zOffset="1" hOffset="0.1"/></signal>
    <signal id="b" s="30" t="5" zOffset="2" orientation="+" dynamic="no" type="206" subtype="-1" country="DE">
      <positionInertial x="31" y="32" z="12.5" hdg="0.7"/></signal>
    <signal id="c" s="30" t="5" zOffset="2" orientation="+" dynamic="no" type="206" subtype="-1" country="DE">
      <positionRoad roadId="9" s="40" t="-6"/></signal></signals>)";
  const auto network = MustRead(Document(road.Text() + other.Text()));
  const Furniture furniture = PlaceFurniture(*network);
  ASSERT_EQ(furniture.things.size(), 3u);
  const Placed &at_road = furniture.things[0], &in_world = furniture.things[1], &lost = furniture.things[2];
  EXPECT_EQ(at_road.road, 1u);
  EXPECT_NEAR((at_road.foot_W.head<2>() - Eigen::Vector2d(506.0, 40.0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(at_road.z_offset_m, 1.0);
  EXPECT_NEAR(std::cos(at_road.heading_rad - (-0.5 * geometry::kPi + 0.1)), 1.0, 1e-12);
  EXPECT_EQ(in_world.road, 0u);
  EXPECT_EQ(in_world.foot_W.x(), 31.0);
  EXPECT_EQ(in_world.foot_W.y(), 32.0);
  EXPECT_EQ(in_world.z_W_m, 12.5);
  EXPECT_NEAR(std::cos(in_world.heading_rad - (0.7 + geometry::kPi)), 1.0, 1e-12);
  EXPECT_NEAR((lost.foot_W - OnCircle(30.0, 5.0)).norm(), 0.0, 1e-10);
  for (const LaneKey& key : {LaneKey{0, 0, -1}}) {
    const auto counts = SignalsFor(*network, key);
    ASSERT_EQ(counts.size(), 3u);
    for (const SignalOnLane& signal : counts) EXPECT_EQ(signal.s_m, 30.0);
  }
}

TEST(Placing, ByRoadThenSignalsThenObjectsAsWritten) {
  RoadText one, two;
  two.id = "2";
  two.geometry = R"(<geometry s="0" x="0" y="500" hdg="0" length="100"><line/></geometry>)";
  one.more = two.more =
      R"(<objects><object id="z" type="pole" s="80" t="5" height="1"/>
          <object id="a" type="pole" s="8" t="5" height="1"/></objects>
    <signals><signal id="s" s="50" t="5" zOffset="2" orientation="+" dynamic="no" type="206" subtype="-1"
      country="DE"/></signals>)";
  const auto network = MustRead(Document(one.Text() + two.Text()));
  const Furniture furniture = PlaceFurniture(*network);
  std::string order;
  for (const Placed& placed : furniture.things)
    order += std::to_string(placed.road) + (placed.signal != nullptr ? placed.signal->id : placed.object->id);
  EXPECT_EQ(order, "0s0z0a1s1z1a");
}

// By orientation, by lanes, by section, and by reference to one that stands at another road.
TEST(Placing, SignalsAreForTheTrafficOfTheirLanes) {
  RoadText road = Circle(), other;
  road.left = R"(<lane id="1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>)";
  road.right =
      R"(<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>
          <lane id="-2" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>)";
  road.more =
      R"(<signals><signal id="along" s="60" t="-8" type="274" orientation="+"/>
          <signal id="against" s="20" t="5" type="274" orientation="-"/>
          <signal id="all" s="40" t="5" type="276" orientation="none"/>
      <signal id="second" s="10" t="-8" type="101" orientation="+"><validity fromLane="-2" toLane="-2"/></signal>
      <signalReference s="30" t="0" id="there" orientation="+"/>
        <signalReference s="35" t="0" id="nowhere" orientation="+"/></signals>)";
  other.id = "2";
  other.geometry = R"(<geometry s="0" x="500" y="500" hdg="0" length="100"><line/></geometry>)";
  other.more = R"(<signals><signal id="there" s="5" t="5" type="206" orientation="-"/></signals>)";
  const auto network = MustRead(Document(road.Text() + other.Text()));
  const auto of = [&](int lane) {
    std::string text;
    for (const auto& [s_m, signal] : SignalsFor(*network, {0, 0, lane})) text += fmt::format("{}@{} ", signal->id, s_m);
    return text;
  };
  EXPECT_EQ(of(-1), "there@30 all@40 along@60 ");
  EXPECT_EQ(of(-2), "second@10 there@30 all@40 along@60 ");
  EXPECT_EQ(of(1), "against@20 all@40 ");
  EXPECT_EQ(of(7), "");
}

}  // namespace
}  // namespace rodeira::network

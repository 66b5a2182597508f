// SPDX-License-Identifier: Apache-2.0
// Where crossings for people on foot lie: worked out by hand on straight roads.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/world/lanes/foot_crossings.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::lanes {
namespace {

std::vector<FootCrossing> On(const std::string& more, double length = 100.0) {
  opendrive::RoadText road;
  road.length = length;
  road.geometry = fmt::format("<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"{}\"><line/></geometry>", length);
  road.more = more;
  const auto network = opendrive::MustRead(opendrive::Document(road.Text()));
  const Graph graph(*network);
  return FindFootCrossings(graph, {});
}

constexpr double kTouch_m = 0.96 + 0.6;  // half of the widest car, half a person and what is spare
constexpr double kFound_m = 0.51;        // by steps of a quarter of a metre, and one more at each end

// Two lanes of 3.5 m, middles at t = -1.75 and 1.75; the walkway is 3.2 m of 4 m.
void IsSquare(const std::vector<FootCrossing>& crossings) {
  ASSERT_EQ(crossings.size(), 1u);
  const FootCrossing& c = crossings[0];
  ASSERT_EQ(c.passes.size(), 2u);
  EXPECT_NEAR(std::fabs(c.across_W.y()), 1.0, 1e-12);
  EXPECT_NEAR(c.half_width_m, 1.6, 1e-9);
  const double half = 0.5 * c.length_m;
  EXPECT_NEAR(c.begin_W.x(), 50.0, 1e-9);
  EXPECT_NEAR(std::fabs(c.begin_W.y()), half, 1e-9);
  EXPECT_NEAR(half, std::max(3.5, 1.75 + kTouch_m + 0.2), 0.02);
  for (const FootPass& pass : c.passes) {
    EXPECT_NEAR(pass.in_m, 50.0 - 1.9, kFound_m);
    EXPECT_LE(pass.in_m, 50.0 - 1.9);
    EXPECT_NEAR(pass.out_m, 50.0 + 1.9, kFound_m);
    EXPECT_GE(pass.out_m, 50.0 + 1.9);
    const double middle = 0.5 * (pass.from_m + pass.to_m);
    EXPECT_NEAR(std::fabs(middle - half), 1.75, 1e-9);
    EXPECT_NEAR(pass.to_m - pass.from_m, 2.0 * kTouch_m, 0.02);
    EXPECT_GE(pass.from_m, 0.2 - 1e-9);
    EXPECT_LE(pass.to_m, c.length_m - 0.2 + 1e-9);
  }
  EXPECT_GT(c.before_m, 3.9);
}

TEST(FootCrossings, AnObjectLiesSquareAcross) {
  IsSquare(On(R"(<objects><object id="z" type="crosswalk" s="50" t="0" zOffset="0" length="4" width="7"/></objects>)"));
}

TEST(FootCrossings, ASignLiesAcrossAllLanes) {
  IsSquare(On(
      R"(<signals><signal s="50" t="-4" id="1" dynamic="no" orientation="+" zOffset="2" type="293" subtype="-1"
          country="DE"/></signals>)"));
}

TEST(FootCrossings, AnOutlineMayBeSkewed) {
  const auto crossings = On(R"(<objects><object id="z" type="crosswalk" s="50" t="0" zOffset="0"><outline>
    <cornerRoad s="46" t="-3.5" dz="0" height="0"/><cornerRoad s="50" t="-3.5" dz="0" height="0"/>
    <cornerRoad s="54" t="3.5" dz="0" height="0"/><cornerRoad s="50" t="3.5" dz="0" height="0"/></outline></object>
      </objects>)");
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_NEAR(std::fabs(crossings[0].across_W.x() / crossings[0].across_W.y()), 4.0 / 7.0, 1e-9);
  ASSERT_EQ(crossings[0].passes.size(), 2u);
  for (const FootPass& pass : crossings[0].passes)
    EXPECT_NEAR(0.5 * (pass.in_m + pass.out_m), 49.0, 0.3);  // 50 m less 1.75 m · 4/7, whichever way
}

TEST(FootCrossings, NothingElseIsOne) {
  EXPECT_TRUE(On("").empty());
  EXPECT_TRUE(
      On(R"(<objects><object id="z" type="crosswalk" s="500" t="0" zOffset="0" length="4" width="7"/></objects>)")
          .empty());
  EXPECT_TRUE(
      On(R"(<objects><object id="z" type="crosswalk" s="50" t="60" zOffset="0" length="4" width="7"/></objects>)")
          .empty());
}

}  // namespace
}  // namespace rodeira::lanes

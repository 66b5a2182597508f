// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/road.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/random.hpp"
#include "tests/common/world/road/sample_world.hpp"

namespace rodeira::road {
namespace {

double Draw(int low, int high, double unit) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1)) * unit;
}

TEST(Road, EvaluatesItsAxis) {
  const Version1Road& road = SampleRoad();
  EXPECT_DOUBLE_EQ(road.length_m(), 305.5);
  const double heading = 5.0 * std::acos(-1.0) / 180.0;
  const RoadFrame at = road.Evaluate(40.0);  // on the first line, before the first parabola
  EXPECT_NEAR(at.p_W.x(), -50.25 + 40.0 * std::cos(heading), 1e-12);
  EXPECT_NEAR(at.p_W.y(), 10.0 + 40.0 * std::sin(heading), 1e-12);
  EXPECT_NEAR(at.p_W.z(), 100.0 + 40.0 * 5.0 / 90.0, 1e-12);
  EXPECT_NEAR(at.heading_rad, heading, 1e-14);
  EXPECT_NEAR(at.grade, 5.0 / 90.0, 1e-14);
  EXPECT_EQ(at.curvature_1pm, 0.0);
  // The headings of clothoids and arcs add up: half the curvature times the length, and all of it.
  const RoadFrame bend = road.Evaluate(125.0);
  EXPECT_NEAR(bend.heading_rad, heading + 0.5 * 20.0 / 45.0 + 25.0 / 45.0, 1e-12);
  EXPECT_NEAR(bend.curvature_1pm, 1.0 / 45.0, 1e-15);
  EXPECT_NEAR(road.Evaluate(200.0).curvature_1pm, -1.0 / 60.0, 1e-15);
  EXPECT_NEAR(road.Evaluate(90.0).vertical_curvature_1pm, (-6.5 / 100.0 - 5.0 / 90.0) / 60.0, 1e-15);
  EXPECT_EQ(road.Evaluate(-3.0).s_m, 0.0);
  EXPECT_EQ(road.Evaluate(999.0).s_m, road.length_m());
}

TEST(Road, KnowsItsLanes) {
  const Version1Road& road = SampleRoad();
  ASSERT_EQ(road.lanes().size(), 2u);
  EXPECT_EQ(road.lanes()[0].id, -1);
  EXPECT_EQ(road.lanes()[0].direction, 1);
  EXPECT_NEAR(road.lanes()[0].speed_limit_mps, 70.0 / 3.6, 1e-12);
  EXPECT_EQ(road.lanes()[1].direction, -1);
  EXPECT_DOUBLE_EQ(road.lanes()[0].centre_t_m(), -1.625);
  EXPECT_DOUBLE_EQ(road.lanes()[1].centre_t_m(), 1.5);
  EXPECT_EQ(road.LaneAt(-3.0)->id, -1);
  EXPECT_EQ(road.LaneAt(0.0)->id, 1);
  EXPECT_EQ(road.LaneAt(3.01), nullptr);
  EXPECT_EQ(road.LaneAt(-3.26), nullptr);
}

TEST(Road, TheCrossSectionFallsFromTheCrown) {
  const Version1Road& road = SampleRoad();
  const double crown = road.Evaluate(60.0).p_W.z();
  EXPECT_DOUBLE_EQ(road.Position(60.0, 0.0).z(), crown);
  EXPECT_NEAR(road.Position(60.0, 2.0).z(), crown - 0.025 * 2.0, 1e-12);
  EXPECT_NEAR(road.Position(60.0, -2.0).z(), crown - 0.025 * 2.0, 1e-12);
  EXPECT_NEAR(road.Position(60.0, 3.5).z(), crown - 0.025 * 3.5, 1e-12);
  EXPECT_NEAR(road.Position(60.0, -4.5).z(), crown - 0.025 * 3.25 - 0.06 * 1.25, 1e-12);
  EXPECT_NEAR(road.Position(60.0, -6.0).z(), crown - 0.025 * 3.25 - 0.06 * 1.25 - 0.1 * 1.5, 1e-12);
}

TEST(Road, OneSidedCrossfallGoesThroughTheCrown) {
  const auto road = Version1Road::Parse(SampleWith("kind: crown, fall: 0.025", "kind: right, fall: 0.03"));
  const double axis = road.Evaluate(60.0).p_W.z();
  EXPECT_NEAR(road.Position(60.0, 2.0).z(), axis + 0.06, 1e-12);
  EXPECT_NEAR(road.Position(60.0, -2.0).z(), axis - 0.06, 1e-12);
}

RC_GTEST_PROP(Road, LocateLeadsBack, ()) {
  const Version1Road& road = SampleRoad();
  const double s = Draw(0, 305'500, 0.001), t = Draw(-13'000, 12'000, 0.001);
  const Eigen::Vector3d p = road.Position(s, t);
  const auto found = road.Locate(p.x(), p.y());
  RC_ASSERT(found.has_value());
  RC_ASSERT(std::fabs(found->s_m - s) < 1e-9);
  RC_ASSERT(std::fabs(found->t_m - t) < 1e-9);
  RC_ASSERT((road.Position(found->s_m, found->t_m) - p).norm() < 1e-9);
}

TEST(Road, LocateSaysWhereThereIsNoRoad) {
  const Version1Road& road = SampleRoad();
  const geometry::PlanPoint start = road.plan().Evaluate(0.0);
  const Eigen::Vector2d before = start.p_W - 0.01 * start.tangent_W + 2.0 * start.left_W();
  EXPECT_FALSE(road.Locate(before.x(), before.y()).has_value());
  const Eigen::Vector2d after = start.p_W + 0.01 * start.tangent_W + 2.0 * start.left_W();
  ASSERT_TRUE(road.Locate(after.x(), after.y()).has_value());
  EXPECT_NEAR(road.Locate(after.x(), after.y())->s_m, 0.01, 1e-12);
}

// The length of a line at offset t between two s, by summing chords.
double LengthOfLine(const Road& road, double t, double from, double to) {
  const int steps = 20'000;
  double length = 0.0;
  Eigen::Vector2d before = road.Position(from, t).head<2>();
  for (int i = 1; i <= steps; ++i) {
    const Eigen::Vector2d now = road.Position(from + (to - from) * i / steps, t).head<2>();
    length += (now - before).norm();
    before = now;
  }
  return length;
}

TEST(Road, DashesAreEquallyLongOnTheLineItself) {
  const Version1Road& road = SampleRoad();
  const Mark& inner = road.marks()[1];  // t = 3, from 10 to 250, strokes 3 m, gaps 5 m
  const auto strokes = road.Strokes(inner);
  ASSERT_GT(strokes.size(), 25u);
  EXPECT_EQ(strokes.front().from_s_m, 10.0);
  for (std::size_t i = 0; i + 1 < strokes.size(); ++i) {
    EXPECT_NEAR(LengthOfLine(road, 3.0, strokes[i].from_s_m, strokes[i].to_s_m), 3.0, 1e-6) << i;
    EXPECT_NEAR(LengthOfLine(road, 3.0, strokes[i].to_s_m, strokes[i + 1].from_s_m), 5.0, 1e-6) << i;
  }
  EXPECT_LE(strokes.back().to_s_m, 250.0);
  const auto edge = road.Strokes(road.marks()[0]);
  ASSERT_EQ(edge.size(), 1u);
  EXPECT_EQ(edge[0].to_s_m, road.length_m());
}

TEST(Road, IsPaintedExactlyWhereTheStrokesAre) {
  const Version1Road& road = SampleRoad();
  for (const std::size_t mark : {0u, 1u, 2u}) {
    const auto strokes = road.Strokes(road.marks()[mark]);
    for (std::uint64_t i = 0; i < 3000; ++i) {
      const double s = base::RandomUniform({i, mark}, 0.0, road.length_m());
      bool expected = false, near_an_end = false;
      for (const Version1Road::Stroke& stroke : strokes) {
        expected |= s >= stroke.from_s_m && s <= stroke.to_s_m;
        near_an_end |= std::fabs(s - stroke.from_s_m) < 1e-6 || std::fabs(s - stroke.to_s_m) < 1e-6;
      }
      if (near_an_end) continue;
      const double heading = road.plan().Evaluate(s).heading_rad;
      EXPECT_EQ(road.IsPainted(s, road.marks()[mark].t_m + 0.049, heading), expected) << s;
      EXPECT_FALSE(road.IsPainted(s, road.marks()[mark].t_m + 0.07, heading));
    }
  }
}

}  // namespace
}  // namespace rodeira::road

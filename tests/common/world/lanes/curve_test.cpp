// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/geometry/plane.hpp"
#include "common/world/lanes/graph.hpp"
#include "common/world/lanes/swath.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::lanes {
namespace {

// The lane's middle as the network has it, wherever the lane keeps its width.
TEST(LaneCurve, IsTheMiddleOfTheLane) {
  for (const std::string& name : MapNames()) {
    const auto network = MapNetwork(name);
    const Graph graph(*network);
    ASSERT_FALSE(graph.tracks().empty()) << name;
    for (const Track& track : graph.tracks()) {
      for (double d = 0.0; d < track.length_m(); d += 0.37) {
        if (track.curve.WidthAt(d) < 3.0) continue;
        const Eigen::Vector3d exact = network->Centre(track.lane, track.curve.StationAt(d));
        const Eigen::Vector3d away = track.curve.At(d).p_W - exact;
        const Eigen::Vector2d ahead = track.curve.At(d).ahead_W;
        EXPECT_NEAR(geometry::Cross(ahead, away.head<2>()), 0.0, 1e-4)
            << name << " road " << track.lane.road << " d " << d;
        EXPECT_NEAR(away.z(), 0.0, 1e-3);
      }
    }
  }
}

// d is the length: the sum of short chords, with an error of h²κ²/24 of it. The maps' pieces are fitted within 5 mm,
// and where two meet the direction may jump.
TEST(LaneCurve, MeasuresItsOwnLength) {
  const auto network = MapNetwork("roundabout");
  const Graph graph(*network);
  ASSERT_FALSE(graph.tracks().empty());
  for (const Track& track : graph.tracks()) {
    double length = 0.0;
    Eigen::Vector2d last = track.curve.At(0.0).p_W.head<2>();
    const int count = 1 + static_cast<int>(track.length_m() / 0.02);
    for (int i = 1; i <= count; ++i) {
      const Eigen::Vector2d p = track.curve.At(track.length_m() * i / count).p_W.head<2>();
      length += (p - last).norm();
      last = p;
    }
    EXPECT_NEAR(length, track.length_m(), 0.005 + 1e-5 * track.length_m());
  }
}

// The nodes are the network's own answers, a metre apart; At leaves out those of them that it tells without.
TEST(LaneCurve, GoesThroughAllOfItsNodes) {
  for (const std::string& name : MapNames()) {
    const auto network = MapNetwork(name);
    const Graph graph(*network);
    ASSERT_FALSE(graph.tracks().empty()) << name;
    for (const Track& track : graph.tracks()) {
      ASSERT_GE(track.curve.nodes().size(), 2U) << name;
      for (const Curve::Node& node : track.curve.nodes()) {
        const CurvePoint at = track.curve.At(node.d_m);
        EXPECT_LT((at.p_W - node.p_W).norm(), 2e-6) << name << " road " << track.lane.road << " d " << node.d_m;
        EXPECT_LT((at.ahead_W - node.along_W.head<2>()).norm(), 2e-6);
        EXPECT_NEAR(at.grade, node.along_W.z(), 1e-6);
        EXPECT_NEAR(at.curvature_1pm, node.curvature_1pm, 1e-6);
        EXPECT_NEAR(at.bank, node.bank, 1e-6);
      }
    }
  }
}

TEST(LaneCurve, FindsTheFootOfAPointBesideIt) {
  const auto network = MapNetwork("town");
  const Graph graph(*network);
  ASSERT_FALSE(graph.tracks().empty());
  for (const Track& track : graph.tracks()) {
    for (double d = 1.0; d < track.length_m() - 1.0; d += 3.3) {
      const CurvePoint at = track.curve.At(d);
      for (const double offset : {-1.5, 0.7}) {
        const Eigen::Vector2d p = at.p_W.head<2>() + offset * at.left_W();
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < track.curve.nodes().size(); ++i) {
          if ((track.curve.nodes()[i].p_W.head<2>() - p).norm() <
              (track.curve.nodes()[nearest].p_W.head<2>() - p).norm())
            nearest = i;
        }
        const Curve::Foot foot = track.curve.FootNear(p, nearest);
        EXPECT_NEAR(foot.d_m, d, 1e-3);
        EXPECT_NEAR(foot.offset_m, offset, 1e-3);
      }
    }
  }
}

// Against a rectangle put on a circle, corner by corner and along its sides.
TEST(Swath, HoldsTheRectangleOnACircle) {
  const LargestCar car;
  for (const double R : {4.0, 6.0, 9.0, 15.0, 40.0, 200.0}) {
    const double r = std::sqrt(R * R - 0.25 * car.wheelbase_m * car.wheelbase_m);
    double most = 0.0;
    for (double x = -0.5 * car.length_m; x <= 0.5 * car.length_m + 1e-9; x += car.length_m / 400.0) {
      for (const double y : {-0.5 * car.width_m, 0.5 * car.width_m})
        most = std::max(most, std::fabs(std::hypot(r + y, x) - R));
    }
    EXPECT_NEAR(HalfSwath_m(1.0 / R), most, 1e-9) << R;
    EXPECT_EQ(HalfSwath_m(-1.0 / R), HalfSwath_m(1.0 / R));
  }
  EXPECT_NEAR(HalfSwath_m(0.0), 0.5 * car.width_m, 1e-3);
}

}  // namespace
}  // namespace rodeira::lanes

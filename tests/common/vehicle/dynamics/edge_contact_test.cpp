// SPDX-License-Identifier: Apache-2.0
// What counts as an edge between two answers of the ground: a corner does, a crest or dip that a road has does not,
// however far the wheel rolls between two queries.
#include "common/vehicle/dynamics/edge_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;

constexpr double kRadius_m = 0.3;
constexpr double kPressed_m = 0.02;

// The ground's answer at `x_m`: the plane through (x, height) with this slope.
WheelGround PlaneAt(double x_m, double height_m, double slope) {
  WheelGround ground;
  ground.plane_W = {x_m, 0.0, height_m};
  ground.normal_W = Vector3d(-slope, 0.0, 1.0).normalized();
  ground.inside = true;
  return ground;
}

// A wheel that rolls by `way_m` along a dip (a crest for a negative radius), pressed in by 20 mm all the time.
WheelGround AlongADip(double radius_m, double way_m) {
  const WheelGround before = PlaneAt(0.0, 0.0, 0.0);
  WheelGround now = PlaneAt(way_m, way_m * way_m / (2.0 * radius_m), way_m / radius_m);
  const Vector3d hub_W = now.plane_W + (kRadius_m - kPressed_m) * now.normal_W;
  RollOn(before, {hub_W, Vector3d::UnitY(), kRadius_m}, now);
  return now;
}

TEST(EdgeContact, ADipOrACrestOfARoadIsNoEdgeOverAnyWay) {
  for (const double way_m : {0.001, 0.03, 0.1, 0.3, 0.5}) {
    for (const double radius_m : {11.0, 30.0, -11.0, -30.0, 1000.0}) {
      const WheelGround now = AlongADip(radius_m, way_m);
      EXPECT_FALSE(now.edge) << radius_m << " m over " << way_m << " m";
      EXPECT_EQ(now.plane_W, Vector3d(way_m, 0.0, way_m * way_m / (2.0 * radius_m)));
    }
  }
}

// 0.3 m in a dip of 2 m radius are 22 mm; 1 mm of the same is less than a tyre notices.
TEST(EdgeContact, ADipAsTightAsAHoleIsAnEdgeWhereTheTyreFeelsIt) {
  EXPECT_TRUE(AlongADip(2.0, 0.3).edge.has_value());
  EXPECT_TRUE(AlongADip(2.0, 0.1).edge.has_value());
  EXPECT_FALSE(AlongADip(2.0, 0.001).edge.has_value());
}

// The tyre keeps what it bore, whether the wheel came by 1 mm or by 0.3 m.
TEST(EdgeContact, AKerbIsAnEdgeOverAnyWay) {
  for (const double way_m : {0.001, 0.03, 0.3}) {
    const WheelGround before = PlaneAt(0.0, 0.0, 0.0);
    WheelGround now = PlaneAt(way_m, 0.1, 0.0);
    const Vector3d hub_W(way_m, 0.0, kRadius_m - kPressed_m);
    RollOn(before, {hub_W, Vector3d::UnitY(), kRadius_m}, now);
    ASSERT_TRUE(now.edge.has_value()) << way_m;
    EXPECT_TRUE(now.edge->rises);
    EXPECT_NEAR((hub_W - now.plane_W).dot(now.normal_W), kRadius_m - kPressed_m, 1e-9);
    EXPECT_GT(now.edge->point_W.x(), way_m);
    EXPECT_NEAR(now.edge->point_W.z(), 0.1, 1e-9);
  }
}

}  // namespace
}  // namespace rodeira::dynamics

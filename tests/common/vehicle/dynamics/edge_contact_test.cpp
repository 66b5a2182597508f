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

// How far the wheel's plane reaches into the disc, along the disc's radius.
double Pressed(const WheelDisc& disc, const WheelGround& ground) {
  const double tilt = disc.axle_W.dot(ground.normal_W);
  return kRadius_m - (disc.hub_W - ground.plane_W).dot(ground.normal_W) / std::sqrt(1.0 - tilt * tilt);
}

// A face of 7 in 1 that lies 15 to 75 degrees askew: the wheel leaves it over its upper edge, and does not meet it as a
// wall.
TEST(EdgeContact, AFaceThatFallsAskewIsLeftOverItsUpperEdge) {
  for (const Vector3d& axle_W : {Vector3d(Vector3d::UnitY()), Vector3d(Vector3d::Zero())}) {
    for (const double askew_deg : {15.0, 45.0, 75.0}) {
      SCOPED_TRACE(askew_deg);
      const double askew = askew_deg * std::acos(-1.0) / 180.0;
      const Vector3d down(std::cos(askew), std::sin(askew), 0.0);
      WheelGround ground = PlaneAt(-0.02, 0.0, 0.0);
      int turning = 0;
      for (double x_m = -0.01; x_m < 0.4; x_m += 0.01) {
        const WheelGround before = ground;
        ground = PlaneAt(x_m, 0.0, 0.0);
        if (x_m > 0.0) {
          ground.plane_W.z() = -7.0 * x_m * down.x();
          ground.normal_W = Vector3d(7.0 * down.x(), 7.0 * down.y(), 1.0).normalized();
        }
        const WheelDisc disc{{x_m, 0.0, kRadius_m - kPressed_m}, axle_W, kRadius_m};
        RollOn(before, disc, ground);
        EXPECT_LE(Pressed(disc, ground), kPressed_m + 3e-4) << x_m;
        if (!ground.edge) continue;
        ++turning;
        EXPECT_FALSE(ground.edge->rises) << x_m;
      }
      EXPECT_GT(turning, 5);
    }
  }
}

// A kerb that rises to the side as well presses the tyre in no further.
TEST(EdgeContact, AKerbThatAlsoRisesToTheSideKeepsWhatTheTyreBore) {
  for (const Vector3d& axle_W : {Vector3d(Vector3d::UnitY()), Vector3d(Vector3d::Zero())}) {
    const WheelGround before = PlaneAt(0.0, 0.0, 0.0);
    WheelGround now = PlaneAt(0.01, 0.08, 0.0);
    now.normal_W = Vector3d(-0.2, -0.5, 1.0).normalized();
    const WheelDisc disc{{0.01, 0.0, kRadius_m - kPressed_m}, axle_W, kRadius_m};
    RollOn(before, disc, now);
    ASSERT_TRUE(now.edge.has_value());
    EXPECT_TRUE(now.edge->rises);
    EXPECT_NEAR(Pressed(disc, now), kPressed_m, 1e-9);
  }
}

}  // namespace
}  // namespace rodeira::dynamics

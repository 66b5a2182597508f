// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/camera/placing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "tests/common/view/scene/worlds.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

Ray Through(const Vector3d& from, const Vector3d& to) { return {from, (to - from).normalized()}; }

// Of an inclined plane the place is known: from + t along where n (from + t along) = d.
TEST(Placing, ARayMeetsAPlaneWhereItsFormulaSays) {
  ground::PlaneGround plane({3.0, -2.0, 7.0}, 0.08, -0.05);
  const Vector3d normal(-0.08, 0.05, 1.0);
  const double level = normal.dot(Vector3d(3.0, -2.0, 7.0));
  for (const Vector3d& along :
       {Vector3d(0.0, 0.0, -1.0), Vector3d(1.0, 0.3, -0.4), Vector3d(-2.0, 1.0, -0.35), Vector3d(0.2, -5.0, -0.4)}) {
    const Ray ray{{10.0, 20.0, 40.0}, along.normalized()};
    const auto met = GroundOn(plane, ray);
    ASSERT_TRUE(met) << along.transpose();
    const double way = (level - normal.dot(ray.from_W)) / normal.dot(ray.along_W);
    EXPECT_NEAR(((*met) - (ray.from_W + way * ray.along_W)).z(), 0.0, 0.01) << along.transpose();
    EXPECT_NEAR(met->z(), plane.At(met->x(), met->y()).z_m, 0.01);
  }
  EXPECT_FALSE(GroundOn(plane, {{0.0, 0.0, 40.0}, Vector3d::UnitZ()})) << "into the sky";
  EXPECT_FALSE(GroundOn(plane, {{0.0, 0.0, -40.0}, -Vector3d::UnitZ()})) << "from below";
}

// On hills: what is met lies on SUELO, and nothing of the way before it lies under the ground.
TEST(Placing, OnHillsTheFirstPlaceIsMet) {
  const auto world = N222();
  const auto ground = world->MakeGround();
  const auto& start = world->start();
  const Vector3d eye(start.x_m, start.y_m, world->At(start.x_m, start.y_m).z_m + 25.0);
  int met_any = 0;
  for (int i = 0; i < 60; ++i) {
    const double angle = 0.105 * i;
    const Ray ray{eye, Vector3d(std::cos(angle), std::sin(angle), -0.05 - 0.01 * (i % 20)).normalized()};
    const auto met = GroundOn(*ground, ray);
    if (!met) continue;
    ++met_any;
    EXPECT_NEAR(met->z(), world->At(met->x(), met->y(), met->z()).z_m, 0.01);
    const double way = (*met - eye).norm();
    for (double before = 0.5; before < way - 0.5; before += 0.5) {
      const Vector3d p = eye + before * ray.along_W;
      ASSERT_GT(p.z(), world->At(p.x(), p.y(), p.z()).z_m - 0.01) << i << ": " << before << " of " << way;
    }
  }
  EXPECT_GT(met_any, 40);
}

TEST(Placing, BeyondTheWorldThereIsNoGround) {
  const auto world = N222();
  const auto ground = world->MakeGround();
  const auto extents = world->extents();
  EXPECT_FALSE(GroundOn(*ground, Through({extents.east_m + 300.0, extents.north_m + 300.0, 900.0},
                                         {extents.east_m + 301.0, extents.north_m + 300.0, 0.0})));
}

TEST(Placing, ACarStandsInTheDirectionOfItsLanesTraffic) {
  const auto world = PlaneWithRoad();
  const Version1Road& road = PlaneRoad();
  for (const double s : {5.0, 40.0, 70.0, 100.0}) {
    const double along = road.Evaluate(s).heading_rad;
    for (const int id : {-1, 1}) {
      const Vector3d p = road.Position(s, road.LaneCentre(id));
      const CarPlace place = PlaceAt(*world, p, 0.3);
      EXPECT_TRUE(place.on_lane);
      EXPECT_NEAR(std::remainder(place.heading_rad - along - (id > 0 ? geometry::kPi : 0.0), 2.0 * geometry::kPi), 0.0,
                  1e-6)
          << s << " " << id;
      EXPECT_EQ(place.x_m, p.x());
    }
  }
  const CarPlace beside = PlaceAt(*world, {0.0, 80.0, 10.0}, 0.3);
  EXPECT_FALSE(beside.on_lane);
  EXPECT_EQ(beside.heading_rad, 0.3);
}

}  // namespace
}  // namespace rodeira::scene

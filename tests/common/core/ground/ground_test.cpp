// SPDX-License-Identifier: Apache-2.0
#include "common/core/ground/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rodeira::ground {
namespace {

TEST(PlaneGround, IsThePlaneEverywhere) {
  PlaneGround plane({10.0, 20.0, 5.0}, 0.03, -0.04, 0.7, Surface::kGravel);
  const GroundPoint here = plane.At(110.0, 70.0);
  EXPECT_NEAR(here.z_m, 5.0 + 3.0 - 2.0, 1e-12);
  EXPECT_NEAR(here.normal_W.norm(), 1.0, 1e-15);
  EXPECT_NEAR(here.normal_W.dot(Eigen::Vector3d(1.0, 0.0, 0.03)), 0.0, 1e-15);
  EXPECT_NEAR(here.normal_W.dot(Eigen::Vector3d(0.0, 1.0, -0.04)), 0.0, 1e-15);
  EXPECT_EQ(here.friction, 0.7);
  EXPECT_EQ(here.surface, Surface::kGravel);
  EXPECT_TRUE(plane.At(1e7, -1e7).inside);
}

TEST(Patch, LiesAboutItsMiddleFromRearRightToFrontLeft) {
  PlaneGround plane({0.0, 0.0, 0.0}, 0.1, 0.01);
  GroundPatch patch{10.0, 20.0, 0.5 * 3.14159265358979323846, 4.0, 2.0,
                    3,    2};  // heading north: forward is +y, left is -x
  std::vector<GroundPoint> points(patch.size());
  plane.Patch(patch, points);
  const Eigen::Vector2d expected[] = {{11.0, 18.0}, {9.0, 18.0}, {11.0, 20.0}, {9.0, 20.0}, {11.0, 22.0}, {9.0, 22.0}};
  for (int i = 0; i < 6; ++i) {
    const GroundQuery query = PatchPoint(patch, i / 2, i % 2);
    EXPECT_NEAR((Eigen::Vector2d(query.x_m, query.y_m) - expected[i]).norm(), 0.0, 1e-14) << i;
    EXPECT_NEAR(points[static_cast<std::size_t>(i)].z_m, 0.1 * expected[i].x() + 0.01 * expected[i].y(), 1e-14) << i;
  }
  patch.along = patch.across = 1;
  points.resize(1);
  plane.Patch(patch, points);
  EXPECT_EQ(points[0].z_m, plane.At(10.0, 20.0).z_m);
}

// Floors over one another, by the law of the hint: the highest one with z <= hint + 0.5 m, the top one without a hint.
class Floors final : public Ground {
 public:
  explicit Floors(std::vector<double> z_m) : z_m_(std::move(z_m)) {}  // from the top down
  void Query(std::span<const GroundQuery> queries, std::span<GroundPoint> points) override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      points[i] = {};
      for (const double z : z_m_) {
        if (!std::isnan(queries[i].z_hint_m) && z > queries[i].z_hint_m + kMaxAboveHint_m) continue;
        points[i].z_m = z;
        points[i].inside = true;
        break;
      }
    }
  }

 private:
  std::vector<double> z_m_;
};

TEST(Layers, AreAllSurfacesFromTheTopDown) {
  for (const std::vector<double>& floors :
       {std::vector<double>{}, {3.0}, {12.0, 5.5, 5.25, 0.0, -2.0}, {1e6, 1e6 - 0.001}, {0.1, 0.1 - 1e-5}}) {
    Floors ground(floors);
    const std::vector<GroundPoint> layers = ground.Layers(1.0, 2.0);
    ASSERT_EQ(layers.size(), floors.size());
    for (std::size_t i = 0; i < floors.size(); ++i) EXPECT_EQ(layers[i].z_m, floors[i]);
  }
  PlaneGround plane;
  EXPECT_EQ(plane.Layers(3.0, 4.0).size(), 1u);
}

TEST(Surface, EveryKindHasItsName) {
  EXPECT_EQ(SurfaceName(Surface::kAsphalt), "asphalt");
  EXPECT_EQ(SurfaceName(Surface::kRoadMark), "road_mark");
  EXPECT_EQ(SurfaceName(static_cast<Surface>(99)), "unknown");
}

}  // namespace
}  // namespace rodeira::ground

#include "common/terrain/ground.hpp"

#include <gtest/gtest.h>

#include <array>

namespace rodeira::terrain {
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

TEST(Surface, EveryKindHasItsName) {
  EXPECT_EQ(SurfaceName(Surface::kAsphalt), "asphalt");
  EXPECT_EQ(SurfaceName(Surface::kRoadMark), "road_mark");
  EXPECT_EQ(SurfaceName(static_cast<Surface>(99)), "unknown");
}

}  // namespace
}  // namespace rodeira::terrain

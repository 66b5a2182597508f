// SPDX-License-Identifier: Apache-2.0
// How the drawn ground is lit: by normals that a picture can take at samples outside the triangle, and that are SUELO's
// where the ground turns sharply.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tests/common/view/scene/ground_tiles.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

constexpr double kWidth_m = 0.5;  // of what a pixel sees of the ground, some 25 m ahead of an eye over a road

struct Lit {
  int triangles = 0,
      creased = 0;  // creased: those with a normal that differed from some corner's, had they kept their corners'
  double worst_change = 0.0;     // of the normal over half a metre across a triangle
  double worst_apart_rad = 0.0;  // of a creased triangle's normal from SUELO's at its middle
};

// N222's sharp bend, where the slopes of cuts and fills run out at the verge to no height at all.
Lit BendOfN222(std::size_t level) {
  const auto world = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/n222.yaml").value();
  const GroundPlan plan(*world);
  Lit lit;
  for (const TileKey& key : plan.tiles()) {
    const Eigen::Vector2d from_W = Eigen::Vector2d(-1508.0, -690.0) - key.south_west_W();
    if (from_W.minCoeff() < 0.0 || from_W.maxCoeff() >= kTile_m) continue;
    const GroundTile tile = plan.Build(key);
    for (const Mesh& mesh : tile.levels[level].ground) {
      for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
        if (IsWall(mesh, i)) continue;
        const auto p_W = CornersOf(mesh, i);
        const Eigen::Vector3d twice_area_W = (p_W[1] - p_W[0]).cross(p_W[2] - p_W[0]);
        std::array<Eigen::Vector3d, 3> n_W;
        double longest_m = 0.0, change = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          n_W[k] = mesh.normals[mesh.triangles[3 * i + k]].cast<double>();
          longest_m = std::max(longest_m, (p_W[(k + 1) % 3] - p_W[k]).norm());
        }
        for (std::size_t k = 0; k < 3; ++k) change = std::max(change, (n_W[(k + 1) % 3] - n_W[k]).norm());
        const double thickness_m = twice_area_W.norm() / longest_m;
        lit.worst_change = std::max(lit.worst_change, change / thickness_m * kWidth_m);
        ++lit.triangles;
        if (change > 0.0 || thickness_m < 0.05) continue;
        ++lit.creased;
        const Eigen::Vector3d middle_W = (p_W[0] + p_W[1] + p_W[2]) / 3.0;
        const road::SurfacePoint at = world->At(middle_W.x(), middle_W.y(), middle_W.z());
        const Eigen::Vector3d asked_W = Eigen::Vector3d(-at.slope_x, -at.slope_y, 1.0).normalized();
        lit.worst_apart_rad = std::max(lit.worst_apart_rad, std::acos(std::min(1.0, n_W[0].dot(asked_W))));
      }
    }
  }
  return lit;
}

// As the normals of corners are the ground's on one side, a triangle a centimetre thick on the foot of a slope had
// normals 0.7 apart; taken at a sample half a pixel outside it light was anything, down to none: rows of dark dots
// along every verge.
TEST(GroundNormals, ChangeLittleWithinAPixel) {
  for (const std::size_t level : {0, 1, 2, 3}) {
    const Lit lit = BendOfN222(level);
    EXPECT_GT(lit.triangles, 400) << level;
    EXPECT_LE(lit.worst_change, 0.3 + 1e-6) << level;
  }
}

TEST(GroundNormals, AreSueloSBesideACrease) {
  const Lit lit = BendOfN222(0);
  EXPECT_GT(lit.creased, 100);
  EXPECT_LE(lit.worst_apart_rad, 0.15);
  std::printf("%d of %d triangles have one normal, %.3f rad from SUELO's at most\n", lit.creased, lit.triangles,
              lit.worst_apart_rad);
}

}  // namespace
}  // namespace rodeira::scene

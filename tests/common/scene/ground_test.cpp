// The ground as it is drawn, against SUELO and against itself.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/base/random.hpp"
#include "common/scene/ground_tile.hpp"
#include "tests/common/scene/ground_worlds.hpp"

namespace rodeira::scene {
namespace {

std::vector<GroundTile> BuildAll(const road::World& world, unsigned threads = 0) {
  const GroundPlan plan(world, threads);
  std::vector<GroundTile> tiles(plan.tiles().size());
  ForEachAtOnce(tiles.size(), threads, [&](std::size_t i) { tiles[i] = plan.Build(plan.tiles()[i]); });
  return tiles;
}

bool IsWall(const Mesh& mesh, std::size_t triangle) { return std::fabs(mesh.normals[mesh.triangles[3 * triangle]].z()) < 1e-6F; }

std::array<Eigen::Vector3d, 3> CornersOf(const Mesh& mesh, std::size_t triangle) {
  return {mesh.PositionW(mesh.triangles[3 * triangle]), mesh.PositionW(mesh.triangles[3 * triangle + 1]), mesh.PositionW(mesh.triangles[3 * triangle + 2])};
}

struct Correlation {
  int asked = 0;
  int stepped = 0;  // within a hand's width of a step of SUELO
  double worst_m = 0.0;
  Eigen::Vector3d where = Eigen::Vector3d::Zero();
};

// Points on the finest level's road triangles, evenly by area, against SUELO at the same place and level.
Correlation Correlate(const road::World& world, const std::vector<GroundTile>& tiles, int count, std::uint64_t seed) {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  std::vector<double> sums;
  for (const GroundTile& tile : tiles) {
    for (const Mesh& mesh : tile.levels[0].ground) {
      if (mesh.material != Material::kRoad) continue;
      for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
        if (IsWall(mesh, i)) continue;
        triangles.push_back(CornersOf(mesh, i));
        const Eigen::Vector3d u = triangles.back()[1] - triangles.back()[0], v = triangles.back()[2] - triangles.back()[0];
        sums.push_back((sums.empty() ? 0.0 : sums.back()) + 0.5 * u.cross(v).norm());
      }
    }
  }
  Correlation result;
  if (triangles.empty()) return result;
  for (int n = 0; n < count; ++n) {
    const auto draw = [&](std::uint64_t what) { return base::RandomUniform({seed, static_cast<std::uint64_t>(n), what}, 0.0, 1.0); };
    const auto found = std::upper_bound(sums.begin(), sums.end(), draw(0) * sums.back());
    const auto& t = triangles[std::min(static_cast<std::size_t>(found - sums.begin()), triangles.size() - 1)];
    double a = draw(1), b = draw(2);
    if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
    const Eigen::Vector3d p = t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
    ++result.asked;
    const road::SurfacePoint at = world.At(p.x(), p.y(), p.z() + 0.3);
    const double error = at.inside ? std::fabs(at.z_m - p.z()) : 1e9;
    if (error > 0.005) {
      // A step of SUELO itself: a drawn line is up to 1 mm beside the edge at which it steps.
      bool steps = false;
      for (int k = 0; k < 8 && !steps; ++k) {
        const double angle = 0.785398 * k;
        const road::SurfacePoint near = world.At(p.x() + 0.003 * std::cos(angle), p.y() + 0.003 * std::sin(angle), p.z() + 0.3);
        steps = near.inside && std::fabs(near.z_m - p.z()) < 0.005;
      }
      if (steps) {
        ++result.stepped;
        continue;
      }
    }
    if (error > result.worst_m) result.worst_m = error, result.where = p;
  }
  return result;
}

TEST(Ground, IsWhereTheTyresAre) {
  const auto world = OpenDriveWorld(BendUnderBridge());
  ASSERT_NE(world, nullptr);
  const Correlation found = Correlate(*world, BuildAll(*world), 100'000, 1);
  EXPECT_EQ(found.asked, 100'000);
  EXPECT_LT(found.stepped, 200);
  EXPECT_LT(found.worst_m, 0.005) << "at " << found.where.transpose();
}

TEST(Ground, IsWhereTheTyresAreOnRealFiles) {
  for (const char* name : {"carla_Town04", "esmini_curves_elevation", "esmini_e6mini", "esmini_fabriksgatan", "esmini_highway_exit", "esmini_multi_intersections",
                           "esmini_straight_500_superelevation_elevation_curve", "esmini_two_pitched_and_rolled_roads", "asamqc_positive_v18"}) {
    if (!std::filesystem::exists(SharedXodr(name))) GTEST_SKIP() << "skipped: " << SharedXodr(name) << " is absent";
    const auto world = road::World::Load(SharedXodr(name));
    ASSERT_TRUE(world.ok()) << world.error().Text();
    const Correlation found = Correlate(*world.value(), BuildAll(*world.value()), 100'000, 2);
    EXPECT_LT(found.worst_m, 0.005) << name << " at " << found.where.transpose() << ", " << found.stepped << " at steps";
    EXPECT_LT(found.stepped, 500) << name;
  }
}

}  // namespace
}  // namespace rodeira::scene

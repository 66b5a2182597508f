// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/core/base/random.hpp"
#include "tests/common/view/scene/ground_tiles.hpp"
#include "tests/setting.hpp"

// The ground as it is drawn, against SUELO.
namespace rodeira::scene {

// What is asked of a level, in height, and how far beside it what is met may lie: a drawn line may be so far from the
// edge at which SUELO steps.
struct Tolerances {
  std::size_t level = 0;
  double height_m = 0.005;
  double beside_m = 0.003;
};

struct Correlation {
  int asked = 0;
  int stepped = 0;  // only beside it, at a step of SUELO
  int far = 0;      // farther from SUELO than is asked elsewhere
  double worst_m = 0.0;
  Eigen::Vector3d where = Eigen::Vector3d::Zero();
};

// Whether SUELO is at a height within some distance of a place.
inline bool MeetsNearby(const road::World& world, const Eigen::Vector3d& p, double within_m, double beside_m = 0.003) {
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.785398 * k;
    const road::SurfacePoint near =
        world.At(p.x() + beside_m * std::cos(angle), p.y() + beside_m * std::sin(angle), p.z() + 0.3);
    if (near.inside && std::fabs(near.z_m - p.z()) < within_m) return true;
  }
  return false;
}

// Whether SUELO's highest ground steps by more than 2 mm within some distance of a place: the way to 16 places around
// is halved towards its steeper half until a thousandth of it is left, where ground that does not step rises by less.
inline bool StepsNearby(const road::World& world, const Eigen::Vector3d& p, double within_m) {
  const auto height_m = [&](const Eigen::Vector2d& at) {
    const road::SurfacePoint ground = world.At(at.x(), at.y());
    return ground.inside ? ground.z_m : 1e3;
  };
  for (int k = 0; k < 16; ++k) {
    const double angle = M_PI / 8.0 * k;
    Eigen::Vector2d a = p.head<2>(), b = a + within_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    double a_m = height_m(a), b_m = height_m(b);
    for (int half = 0; half < 10; ++half) {
      const Eigen::Vector2d middle = 0.5 * (a + b);
      const double middle_m = height_m(middle);
      if (std::fabs(middle_m - a_m) > std::fabs(b_m - middle_m))
        b = middle, b_m = middle_m;
      else
        a = middle, a_m = middle_m;
    }
    if (std::fabs(b_m - a_m) > 0.002) return true;
  }
  return false;
}

// How far the nearest of SUELO's surfaces there is from a height: land that comes up to a bridge's deck lies less than
// a hint can tell below it.
inline double FromNearest(const road::World& world, const Eigen::Vector3d& p) {
  double nearest_m = 1e9;
  for (road::SurfacePoint at = world.At(p.x(), p.y()); at.inside;) {
    nearest_m = std::min(nearest_m, std::fabs(at.z_m - p.z()));
    const road::SurfacePoint below = world.At(p.x(), p.y(), at.z_m - ground::kMaxAboveHint_m - 1e-6);
    if (!(below.z_m < at.z_m)) break;
    at = below;
  }
  return nearest_m;
}

// A point of the triangles with areas that add up to these sums: one of many that are spread evenly over all of them.
inline Eigen::Vector3d PointIn(const std::vector<std::array<Eigen::Vector3d, 3>>& triangles,
                               const std::vector<double>& sums, std::uint64_t seed, std::uint64_t n) {
  const auto draw = [&](std::uint64_t what) { return base::RandomUniform({seed, n, what}, 0.0, 1.0); };
  const auto found = std::upper_bound(sums.begin(), sums.end(), draw(0) * sums.back());
  const auto& t = triangles[std::min(static_cast<std::size_t>(found - sums.begin()), triangles.size() - 1)];
  double a = draw(1), b = draw(2);
  if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
  return t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
}

inline bool IsRoad(const Mesh& mesh) {
  return mesh.material == Material::kRoad || mesh.material == Material::kConcrete || mesh.material == Material::kGravel;
}

// `count` points that count, on a level's triangles that count, evenly by area, against SUELO at the same place and
// level.
template <class Counts, class PointCounts>
Correlation Correlate(const road::World& world, const std::vector<GroundTile>& tiles, int count, std::uint64_t seed,
                      const Counts& counts, const Tolerances& asked, const PointCounts& point_counts) {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  std::vector<double> sums;
  for (const GroundTile& tile : tiles) {
    for (const Mesh& mesh : tile.levels[asked.level].ground) {
      for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
        if (IsWall(mesh, i) || !counts(mesh, i)) continue;
        triangles.push_back(CornersOf(mesh, i));
        const Eigen::Vector3d u = triangles.back()[1] - triangles.back()[0],
                              v = triangles.back()[2] - triangles.back()[0];
        sums.push_back((sums.empty() ? 0.0 : sums.back()) + 0.5 * u.cross(v).norm());
      }
    }
  }
  Correlation result;
  if (triangles.empty()) return result;
  for (int n = 0; n < 500 * count && result.asked < count; ++n) {
    const Eigen::Vector3d p = PointIn(triangles, sums, seed, static_cast<std::uint64_t>(n));
    if (!point_counts(p)) continue;
    ++result.asked;
    const road::SurfacePoint at = world.At(p.x(), p.y(), p.z() + 0.3);
    double error = at.inside ? std::fabs(at.z_m - p.z()) : 1e9;
    if (error > asked.height_m && !world.open_drive()) error = FromNearest(world, p);
    if (error > asked.height_m && MeetsNearby(world, p, asked.height_m, asked.beside_m)) {
      ++result.stepped;
      continue;
    }
    result.far += error > asked.height_m;
    if (error > result.worst_m) result.worst_m = error, result.where = p;
  }
  return result;
}

// The finest level's.
template <class Counts>
Correlation Correlate(const road::World& world, const std::vector<GroundTile>& tiles, int count, std::uint64_t seed,
                      const Counts& counts) {
  return Correlate(world, tiles, count, seed, counts, Tolerances{}, [](const Eigen::Vector3d&) { return true; });
}

inline Correlation Correlate(const road::World& world, const std::vector<GroundTile>& tiles, int count,
                             std::uint64_t seed) {
  return Correlate(world, tiles, count, seed, [](const Mesh& mesh, std::size_t) { return IsRoad(mesh); });
}

inline int Points() { return static_cast<int>(Setting("RODEIRA_GROUND_POINTS", 5'000)); }

}  // namespace rodeira::scene

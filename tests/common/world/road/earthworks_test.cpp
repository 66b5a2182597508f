// SPDX-License-Identifier: Apache-2.0
// Cuts and fills against what they are by definition: of all points of all roads' edges none is left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/world/road/built_ground.hpp"
#include "common/world/road/world.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

constexpr double kEvery_m = 0.1;    // of edges' points
constexpr double kNoSteeper = 0.8;  // of what they reach: so far slopes go straight on
constexpr double kFromJunctions_m = 75.0, kFromEdges_m = 0.5;

// Points of the outermost edges of all roads that stand on the ground, in squares as wide as slopes reach at most.
class Edges {
 public:
  explicit Edges(const network::Network& network) {
    for (const network::Road& road : network.roads()) {
      if (!road.spec().earthwork) continue;
      EXPECT_LE(road.spec().earthwork->reach_m, kSquare_m);
      const auto add = [&](double s) {
        double right, left;
        road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
        for (const double t : {right, left}) {
          const Eigen::Vector3d p = road.Surface(s, t).p_W;
          squares_[Square(p.head<2>())].push_back({p, *road.spec().earthwork});
        }
      };
      const int count = static_cast<int>(road.length_m() / kEvery_m) + 1;
      for (int k = 0; k <= count; ++k) {
        const double s = std::min(k * kEvery_m, road.length_m());
        if (!IsExempt(road.spec(), s)) add(s);
      }
      // Under a bridge's end the ground hangs on the very end of what stands before it.
      for (const network::Structure& structure : road.spec().structures) {
        for (const double s : {structure.s_m, structure.s_m + structure.length_m}) {
          if (s > 0.0 && s < road.length_m()) add(s);
        }
      }
    }
  }

  struct Bounds {
    double low_m = -std::numeric_limits<double>::infinity(), high_m = -low_m;
    double low_away = 0.0, high_away = 0.0;  // how far their points are, as a part of what they reach
  };
  Bounds At(const Eigen::Vector2d& p_W) const {
    Bounds bounds;
    const auto [column, row] = Square(p_W);
    for (std::int64_t c = column - 1; c <= column + 1; ++c) {
      for (std::int64_t r = row - 1; r <= row + 1; ++r) {
        const auto square = squares_.find({c, r});
        if (square == squares_.end()) continue;
        for (const Point& edge : square->second) {
          const double away_m = (edge.p_W.head<2>() - p_W).norm();
          if (away_m >= edge.slopes.reach_m) continue;
          const double low_m = edge.p_W.z() - away_m / edge.slopes.fill,
                       high_m = edge.p_W.z() + away_m / edge.slopes.cut;
          if (low_m > bounds.low_m) bounds.low_m = low_m, bounds.low_away = away_m / edge.slopes.reach_m;
          if (high_m < bounds.high_m) bounds.high_m = high_m, bounds.high_away = away_m / edge.slopes.reach_m;
        }
      }
    }
    return bounds;
  }

 private:
  static constexpr double kSquare_m = 60.0;
  struct Point {
    Eigen::Vector3d p_W;
    network::Earthwork slopes;
  };
  static std::pair<std::int64_t, std::int64_t> Square(const Eigen::Vector2d& p_W) {
    return {static_cast<std::int64_t>(std::floor(p_W.x() / kSquare_m)),
            static_cast<std::int64_t>(std::floor(p_W.y() / kSquare_m))};
  }
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Point>> squares_;
};

// The terrain, held between the greatest of all lower bounds and the least of all upper ones, each found from all
// points of all edges within reach.
void ExpectTheTightestBounds(const std::string& name, int least_cuts, int least_fills) {
  const auto loaded = World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / (name + ".yaml"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  const World& world = *loaded.value();
  const network::Network& network = *world.network();
  const Edges edges(network);
  std::vector<Eigen::Vector2d> junctions;
  for (const network::Road& road : network.roads()) {
    if (road.spec().junction.empty()) continue;
    for (double s = 0.0; s <= road.length_m(); s += 5.0) junctions.push_back(road.axis().Evaluate(s).p_W);
  }
  int cuts = 0, fills = 0, bare = 0;
  double worst_m = 0.0;
  std::vector<double> lengths_m;
  for (const network::Road& road : network.roads())
    lengths_m.push_back(road.length_m() + (lengths_m.empty() ? 0.0 : lengths_m.back()));
  for (std::uint64_t n = 0; n < 30'000; ++n) {
    const double along_m = base::RandomUniform({n, 61}, 0.0, lengths_m.back());
    const auto drawn = std::upper_bound(lengths_m.begin(), lengths_m.end() - 1, along_m);
    const network::Road& road = network.roads()[static_cast<std::size_t>(drawn - lengths_m.begin())];
    const geometry::PlanPoint at = road.axis().Evaluate(*drawn - along_m);
    const Eigen::Vector2d p = at.p_W + base::RandomUniform({n, 63}, -30.0, 30.0) * at.left_W();
    if (std::any_of(junctions.begin(), junctions.end(), [&](const Eigen::Vector2d& q) {
          return (q - p).squaredNorm() < kFromJunctions_m * kFromJunctions_m;
        }))
      continue;
    const auto place = network.Locate(p.x(), p.y());
    if (!place || place->distance_m < kFromEdges_m) continue;
    const SurfacePoint ground = world.At(p.x(), p.y()), terrain = world.TerrainAt(p.x(), p.y());
    if (!ground.inside || !terrain.inside) continue;
    const Edges::Bounds bounds = edges.At(p);
    if (bounds.low_m > bounds.high_m) continue;
    const double expected_m = std::clamp(terrain.z_m, bounds.low_m, bounds.high_m);
    if (expected_m != terrain.z_m && (expected_m == bounds.low_m ? bounds.low_away : bounds.high_away) > kNoSteeper)
      continue;
    if (expected_m == terrain.z_m && ground.z_m == terrain.z_m)
      ++bare;
    else
      ++(ground.z_m < terrain.z_m ? cuts : fills);
    const double off_m = std::fabs(ground.z_m - expected_m);
    worst_m = std::max(worst_m, off_m);
    // Of each panel its nearest point counts; where the road climbs by g a point ahead of it holds tighter by up to the
    // distance times g squared.
    EXPECT_LT(off_m, 0.05) << name << ": " << p.transpose();
  }
  EXPECT_GT(cuts, least_cuts) << name;
  EXPECT_GT(fills, least_fills) << name;
  EXPECT_GT(bare, 10'000) << name;
  std::printf("%s: %d places in cuts, %d on fills, %d on the terrain itself, worst %.4f m\n", name.c_str(), cuts, fills,
              bare, worst_m);
}

TEST(Earthworks, AreTheTightestBoundsOfAllEdges) {
  ExpectTheTightestBounds("haste", 5, 50);
  ExpectTheTightestBounds("n222", 200, 500);
}

}  // namespace
}  // namespace rodeira::road

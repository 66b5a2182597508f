// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tessellation/edge_points.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "common/view/scene/tessellation/bend.hpp"
#include "common/view/scene/tessellation/levels_at.hpp"
#include "common/view/scene/tessellation/tile_plan.hpp"

namespace rodeira::scene {
namespace {

using tessellation::GridPoint;

constexpr BendRange kEdgeBend = {0.003, 0.02, 2.0};

}  // namespace

void RefineEdges(const road::World& world, const TileKey& tile, std::vector<GridPoint>& edge,
                 const std::array<bool, 4>& decks) {
  const auto size = static_cast<std::int32_t>(kTileSteps);
  std::set<GridPoint> points(edge.begin(), edge.end());
  std::vector<road::SurfacePoint> levels;
  const auto along = [&](bool deck, const auto& point_at) {  // an edge
    const auto levels_at = [&](const Eigen::Vector2d& p_W, std::size_t most) -> const std::vector<road::SurfacePoint>& {
      LevelsAt(world, p_W, most, levels);
      return levels;
    };
    std::vector<std::int32_t> places;
    for (const GridPoint& p : edge) {
      for (const std::int32_t k : {p.x, p.y}) {
        if (point_at(k) == p) places.push_back(k);
      }
    }
    // Each of the ground's levels between two places, also of those that are only below a deck: between the places
    // where lines cross the edge, it is one level.
    const auto refine = [&](std::size_t level) {
      const GroundAt ground = [&, level](const Eigen::Vector2d& p_W) {
        if (level == 0) return world.At(p_W.x(), p_W.y());
        const auto& all = levels_at(p_W, level + 1);
        return all.empty() ? road::SurfacePoint{} : all[std::min(level, all.size() - 1)];
      };
      // A piece's end as it is drawn, seen from within the piece: at a kerb SUELO steps there.
      std::vector<road::SurfacePoint> seen;
      const auto end_z_m = [&](const Eigen::Vector2d& p_W, const Eigen::Vector2d& towards_W) {
        LevelsWithin(world, p_W, towards_W, level + 1, seen, level + 1);
        return seen.empty() ? 0.0 : seen[std::min(level, seen.size() - 1)].z_m;
      };
      std::vector<std::int32_t> more;
      const std::function<void(std::int32_t, std::int32_t, double, double)> divide = [&](std::int32_t a, std::int32_t b,
                                                                                         double at_a, double at_b) {
        const auto part =
            BendBetween(ground, ToWorld(tile, point_at(a)), at_a, ToWorld(tile, point_at(b)), at_b, kEdgeBend);
        if (!part) return;
        const auto bend = static_cast<std::int32_t>(a + std::lround(*part * (b - a)));
        const double at_bend = ground(ToWorld(tile, point_at(bend))).z_m;
        more.push_back(bend);
        divide(a, bend, at_a, at_bend);
        divide(bend, b, at_bend, at_b);
      };
      std::sort(places.begin(), places.end());
      places.erase(std::unique(places.begin(), places.end()), places.end());
      bool any = false;
      for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        const GridPoint a = point_at(places[i]), b = point_at(places[i + 1]);
        const Eigen::Vector2d a_W = ToWorld(tile, a), b_W = ToWorld(tile, b);
        if (level > 0 && levels_at(0.5 * (a_W + b_W), level + 1).size() <= level) continue;
        any = true;
        const Eigen::Vector2d half_W = 0.5 * (a_W + b_W);
        divide(places[i], places[i + 1], end_z_m(a_W, half_W), end_z_m(b_W, half_W));
      }
      places.insert(places.end(), more.begin(), more.end());
      return any;
    };
    for (std::size_t level = 0; level < (deck || world.grid() == nullptr ? kMaxLevels : 1) && refine(level); ++level) {
    }
    for (const std::int32_t k : places) points.insert(point_at(k));
  };
  along(decks[0], [](std::int32_t k) { return GridPoint{0, k}; });
  along(decks[1], [](std::int32_t k) { return GridPoint{k, 0}; });
  along(decks[2], [size](std::int32_t k) { return GridPoint{size, k}; });
  along(decks[3], [size](std::int32_t k) { return GridPoint{k, size}; });
  edge.assign(points.begin(), points.end());
}

}  // namespace rodeira::scene

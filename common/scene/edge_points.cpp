#include "common/scene/edge_points.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "common/scene/bend.hpp"

namespace rodeira::scene {
namespace {

using partition::GridPoint;

constexpr BendRange kEdge = {0.003, 0.02};

}  // namespace

void RefineEdges(const road::World& world, const TileKey& tile, std::vector<GridPoint>& edge) {
  if (world.grid() == nullptr) return;
  const auto size = static_cast<std::int32_t>(kTileSteps);
  std::set<GridPoint> points(edge.begin(), edge.end());
  const auto along = [&](const auto& point_at) {  // an edge
    const auto height = [&](std::int32_t k) {
      const Eigen::Vector2d p_W = ToWorld(tile, point_at(k));
      return world.At(p_W.x(), p_W.y()).z_m;
    };
    const std::function<void(std::int32_t, std::int32_t, double, double)> divide = [&](std::int32_t a, std::int32_t b, double at_a, double at_b) {
      const auto part = BendBetween(world, ToWorld(tile, point_at(a)), at_a, ToWorld(tile, point_at(b)), at_b, kEdge);
      if (!part) return;
      const auto bend = static_cast<std::int32_t>(a + std::lround(*part * (b - a)));
      const double at_bend = height(bend);
      points.insert(point_at(bend));
      divide(a, bend, at_a, at_bend);
      divide(bend, b, at_bend, at_b);
    };
    std::vector<std::int32_t> places;
    for (const GridPoint& p : edge) {
      for (const std::int32_t k : {p.x, p.y}) {
        if (point_at(k) == p) places.push_back(k);
      }
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (std::size_t i = 0; i + 1 < places.size(); ++i) divide(places[i], places[i + 1], height(places[i]), height(places[i + 1]));
  };
  along([](std::int32_t k) { return GridPoint{0, k}; });
  along([](std::int32_t k) { return GridPoint{k, 0}; });
  along([size](std::int32_t k) { return GridPoint{size, k}; });
  along([size](std::int32_t k) { return GridPoint{k, size}; });
  edge.assign(points.begin(), points.end());
}

}  // namespace rodeira::scene

#include "common/scene/edge_points.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace rodeira::scene {
namespace {

using partition::GridPoint;

constexpr double kOff_m = 0.02;
constexpr auto kShortest = static_cast<std::int32_t>(0.5 / kStep_m);

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
      if (b - a < 2 * kShortest) return;
      const std::int32_t middle = a + (b - a) / 2;
      const double at_middle = height(middle);
      bool off = false;
      for (const int quarter : {2, 1, 3}) {
        const std::int32_t k = quarter == 2 ? middle : a + (b - a) / 4 * quarter;
        const double part = static_cast<double>(k - a) / (b - a);
        off = off || std::fabs((quarter == 2 ? at_middle : height(k)) - (at_a + part * (at_b - at_a))) > kOff_m;
      }
      if (!off) return;
      points.insert(point_at(middle));
      divide(a, middle, at_a, at_middle);
      divide(middle, b, at_middle, at_b);
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

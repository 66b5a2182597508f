// SPDX-License-Identifier: Apache-2.0
// Paint laid on the ground's triangles.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/view/scene/road_markings/mark_strips.hpp"
#include "common/view/scene/road_markings/stencils.hpp"

namespace rodeira::scene {
namespace {

constexpr double kBucket_m = 8.0;
constexpr int kBuckets = static_cast<int>(kTile_m / kBucket_m);
constexpr double kPaintLevel_m = 1.0;
constexpr double kLeast_m2 = 1e-9;

double Cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// What of a convex polygon lies to the left of the way from a to b.
void ClipToLeft(Polygon2& polygon, const Eigen::Vector2d& a, const Eigen::Vector2d& b, Polygon2& spare) {
  spare.clear();
  const Eigen::Vector2d way = b - a;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double from = Cross2(way, p - a), to = Cross2(way, q - a);
    if (from >= 0.0) spare.push_back(p);
    if ((from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0)) spare.push_back(p + from / (from - to) * (q - p));
  }
  polygon.swap(spare);
}

double Area2(const Polygon2& polygon) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    area += 0.5 * Cross2(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return area;
}

// Which triangles lie near a place.
class Buckets {
 public:
  Buckets(const TileKey& tile, std::span<const GroundTriangle> ground) : south_west_W_(tile.south_west_W()) {
    cells_.resize(kBuckets * kBuckets);
    for (std::uint32_t i = 0; i < ground.size(); ++i) {
      Eigen::Vector2d low = ground[i].p_W[0].head<2>(), high = low;
      for (const Eigen::Vector3d& p : ground[i].p_W) low = low.cwiseMin(p.head<2>()), high = high.cwiseMax(p.head<2>());
      boxes_.push_back({low, high});
      ForEach(low, high, [&](std::vector<std::uint32_t>& cell) { cell.push_back(i); });
    }
  }

  template <typename Visit>
  void ForEach(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Visit&& visit) {
    const Eigen::Vector2i from = Cell(low), to = Cell(high);
    for (int x = from.x(); x <= to.x(); ++x) {
      for (int y = from.y(); y <= to.y(); ++y) visit(cells_[static_cast<std::size_t>(x * kBuckets + y)]);
    }
  }
  // Whether a triangle may lie in a box.
  bool MayTouch(std::uint32_t triangle, const Eigen::Vector2d& low, const Eigen::Vector2d& high) const {
    const Box& box = boxes_[triangle];
    return (box.low.array() <= high.array()).all() && (box.high.array() >= low.array()).all();
  }

 private:
  struct Box {
    Eigen::Vector2d low, high;
  };
  Eigen::Vector2i Cell(const Eigen::Vector2d& p_W) const {
    const Eigen::Vector2d at = (p_W - south_west_W_) / kBucket_m;
    return {std::clamp(static_cast<int>(std::floor(at.x())), 0, kBuckets - 1),
            std::clamp(static_cast<int>(std::floor(at.y())), 0, kBuckets - 1)};
  }

  Eigen::Vector2d south_west_W_;
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<Box> boxes_;  // by triangle
};

}  // namespace

Mesh LayPaint(std::span<const PaintPiece> pieces, const TileKey& tile, std::span<const GroundTriangle> ground) {
  Mesh mesh;
  mesh.material = Material::kMark;
  mesh.origin_W = TileOrigin(tile, ground.empty() ? 0.0 : ground.front().p_W[0].z());
  Buckets buckets(tile, ground);
  std::vector<std::uint32_t> near;
  Polygon2 polygon, spare;
  for (const PaintPiece& piece : pieces) {
    Eigen::Vector2d low = piece.p_W[0].head<2>(), high = low;
    double z = 0.0;
    for (const Eigen::Vector3d& p : piece.p_W)
      low = low.cwiseMin(p.head<2>()), high = high.cwiseMax(p.head<2>()), z += 0.25 * p.z();
    near.clear();
    buckets.ForEach(low, high, [&](const std::vector<std::uint32_t>& cell) {
      std::copy_if(cell.begin(), cell.end(), std::back_inserter(near),
                   [&](std::uint32_t i) { return buckets.MayTouch(i, low, high); });
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint32_t i : near) {
      const auto& corner = ground[i].p_W;
      polygon.clear();
      for (const Eigen::Vector3d& p : piece.p_W) polygon.push_back(p.head<2>());
      for (std::size_t k = 0; k < 3 && polygon.size() > 2; ++k)
        ClipToLeft(polygon, corner[k].head<2>(), corner[(k + 1) % 3].head<2>(), spare);
      if (polygon.size() < 3 || Area2(polygon) < kLeast_m2) continue;
      const Eigen::Vector3d& n = ground[i].normal_W;
      const auto height = [&](const Eigen::Vector2d& p) {
        return corner[0].z() - n.head<2>().dot(p - corner[0].head<2>()) / n.z();
      };
      if (std::fabs(height(polygon[0]) - z) > kPaintLevel_m + 0.1 * (high - low).norm()) continue;
      std::vector<std::uint32_t> index;
      for (const Eigen::Vector2d& p : polygon) index.push_back(mesh.Add({p.x(), p.y(), height(p)}, n, piece.colour));
      for (std::size_t k = 1; k + 1 < index.size(); ++k) mesh.AddTriangle(index[0], index[k], index[k + 1]);
    }
  }
  return mesh;
}

}  // namespace rodeira::scene

// Lines with fewer points for coarser levels (Douglas and Peucker, 1973).
#include <algorithm>
#include <map>

#include "common/partition/noding.hpp"
#include "common/scene/tile_plan.hpp"

namespace rodeira::scene {
namespace {

using partition::GridPoint;
using partition::GridSegment;

bool OnEdge(const GridPoint& p) { return p.x == 0 || p.y == 0 || p.x == kTileSteps || p.y == kTileSteps; }

class Chains {
 public:
  Chains(std::span<const GridSegment> segments, const TileKey& key, const road::World& world, const Tolerance& tolerance)
      : key_(key), world_(world), tolerance_(tolerance) {
    for (const GridSegment& segment : segments) {
      around_[segment.a].push_back(segment.b);
      around_[segment.b].push_back(segment.a);
    }
  }

  std::vector<partition::GridLine> Take() {
    for (auto& [p, others] : around_) {
      while (IsKnot(p) && !others.empty()) Follow(p);
    }
    for (auto& [p, others] : around_) {  // rings without any knot
      while (!others.empty()) Follow(p);
    }
    return std::move(lines_);
  }

 private:
  struct Point {
    GridPoint p;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
  };

  bool IsKnot(const GridPoint& p) {
    auto [found, fresh] = knots_.try_emplace(p, false);
    if (fresh) found->second = OnEdge(p) || around_[p].size() != 2;
    return found->second;
  }

  void Drop(const GridPoint& from, const GridPoint& to) {
    auto& others = around_[from];
    others.erase(std::find(others.begin(), others.end(), to));
  }

  void Follow(const GridPoint& first) {
    IsKnot(first);
    std::vector<GridPoint> chain = {first};
    do {
      const GridPoint from = chain.back(), to = around_[from].front();
      IsKnot(to);
      Drop(from, to);
      Drop(to, from);
      chain.push_back(to);
    } while (!IsKnot(chain.back()) && chain.back() != first);
    Thin(chain);
  }

  void Thin(const std::vector<GridPoint>& chain) {
    std::vector<Point> points;
    for (const GridPoint& p : chain) {
      const Eigen::Vector2d at = ToWorld(key_, p);
      points.push_back({p, {at.x(), at.y(), world_.At(at.x(), at.y()).z_m}});
    }
    std::vector<bool> kept(points.size(), false);
    kept.front() = kept.back() = true;
    if (chain.front() == chain.back() && points.size() > 2) kept[points.size() / 2] = true;
    std::size_t from = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (!kept[i]) continue;
      Keep(points, from, i, kept);
      from = i;
    }
    partition::GridLine line;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (kept[i]) line.push_back(points[i].p);
    }
    lines_.push_back(std::move(line));
  }

  void Keep(const std::vector<Point>& points, std::size_t from, std::size_t to, std::vector<bool>& kept) const {
    const Eigen::Vector3d& a = points[from].at;
    const Eigen::Vector3d along = points[to].at - a;
    const double length2 = along.head<2>().squaredNorm();
    double worst = 1.0;
    std::size_t farthest = 0;
    for (std::size_t i = from + 1; i < to; ++i) {
      const Eigen::Vector3d d = points[i].at - a;
      const double part = length2 > 0.0 ? std::clamp(d.head<2>().dot(along.head<2>()) / length2, 0.0, 1.0) : 0.0;
      const double plan = (d - part * along).head<2>().norm(), height = std::fabs(d.z() - part * along.z());
      const double error = std::max(plan / tolerance_.plan_m, height / tolerance_.height_m);
      if (error > worst) worst = error, farthest = i;
    }
    if (farthest == 0) return;
    kept[farthest] = true;
    Keep(points, from, farthest, kept);
    Keep(points, farthest, to, kept);
  }

  const TileKey& key_;
  const road::World& world_;
  Tolerance tolerance_;
  std::map<GridPoint, std::vector<GridPoint>> around_;
  std::map<GridPoint, bool> knots_;
  std::vector<partition::GridLine> lines_;
};

}  // namespace

std::vector<GridSegment> Simplify(std::span<const GridSegment> segments, const TileKey& key, const road::World& world,
                                  const Tolerance& tolerance) {
  return partition::Node(Chains(segments, key, world, tolerance).Take());
}

}  // namespace rodeira::scene

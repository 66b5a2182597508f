// SPDX-License-Identifier: Apache-2.0
// Lines with fewer points for coarser levels (Douglas and Peucker, 1973).
#include <algorithm>
#include <map>

#include "common/core/tessellation/noding.hpp"
#include "common/view/scene/tessellation/tile_plan.hpp"

namespace rodeira::scene {
namespace {

using tessellation::GridPoint;
using tessellation::GridSegment;

// The lines between knots: where other than two segments meet, and on the tile's edge.
class Follower {
 public:
  explicit Follower(std::span<const GridSegment> segments) {
    for (const GridSegment& segment : segments) {
      around_[segment.a].push_back(segment.b);
      around_[segment.b].push_back(segment.a);
    }
  }

  std::vector<tessellation::GridLine> Take() {
    for (auto& [p, others] : around_) {
      while (IsKnot(p) && !others.empty()) Follow(p);
    }
    for (auto& [p, others] : around_) {  // rings without any knot
      while (!others.empty()) Follow(p);
    }
    return std::move(lines_);
  }

 private:
  bool IsKnot(const GridPoint& p) {
    auto [found, fresh] = knots_.try_emplace(p, false);
    if (fresh) found->second = IsOnTileEdge(p) || around_[p].size() != 2;
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
    lines_.push_back(std::move(chain));
  }

  std::map<GridPoint, std::vector<GridPoint>> around_;
  std::map<GridPoint, bool> knots_;
  std::vector<tessellation::GridLine> lines_;
};

}  // namespace

TileChains::TileChains(std::span<const GridSegment> segments, const TileKey& key, const road::World& world) {
  for (const tessellation::GridLine& line : Follower(segments).Take()) {
    Chain& chain = chains_.emplace_back();
    for (const GridPoint& p : line) {
      const Eigen::Vector2d at_W = ToWorld(key, p);
      chain.push_back({p, {at_W.x(), at_W.y(), world.At(at_W.x(), at_W.y()).z_m}});
    }
  }
}

std::vector<GridSegment> TileChains::Simplified(const Tolerance& tolerance) const {
  std::vector<tessellation::GridLine> lines;
  for (const Chain& chain : chains_) lines.push_back(Thin(chain, tolerance));
  return tessellation::Node(lines);
}

tessellation::GridLine TileChains::Thin(const Chain& chain, const Tolerance& tolerance) {
  std::vector<bool> kept(chain.size(), false);
  kept.front() = kept.back() = true;
  if (chain.front().p == chain.back().p && chain.size() > 2) kept[chain.size() / 2] = true;
  std::size_t from = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    if (!kept[i]) continue;
    Keep(chain, from, i, tolerance, kept);
    from = i;
  }
  tessellation::GridLine line;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (kept[i]) line.push_back(chain[i].p);
  }
  return line;
}

void TileChains::Keep(const Chain& chain, std::size_t from, std::size_t to, const Tolerance& tolerance,
                      std::vector<bool>& kept) {
  const Eigen::Vector3d& a = chain[from].at_W;
  const Eigen::Vector3d along = chain[to].at_W - a;
  const double length2 = along.head<2>().squaredNorm();
  double worst = 1.0;
  std::size_t farthest = 0;
  for (std::size_t i = from + 1; i < to; ++i) {
    const Eigen::Vector3d d = chain[i].at_W - a;
    const double part = length2 > 0.0 ? std::clamp(d.head<2>().dot(along.head<2>()) / length2, 0.0, 1.0) : 0.0;
    const double plan = (d - part * along).head<2>().norm(), height = std::fabs(d.z() - part * along.z());
    const double error = std::max(plan / tolerance.plan_m, height / tolerance.height_m);
    if (error > worst) worst = error, farthest = i;
  }
  if (farthest == 0) return;
  kept[farthest] = true;
  Keep(chain, from, farthest, tolerance, kept);
  Keep(chain, farthest, to, tolerance, kept);
}

}  // namespace rodeira::scene

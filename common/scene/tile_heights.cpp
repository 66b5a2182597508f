#include "common/scene/tile_heights.hpp"

#include <algorithm>
#include <cmath>

#include "common/scene/levels_at.hpp"

namespace rodeira::scene {
namespace {

bool IsCorner(const partition::GridPoint& p) { return (p.x == 0 || p.x == kTileSteps) && (p.y == 0 || p.y == kTileSteps); }
bool Before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); }

}  // namespace

TileHeights::TileHeights(const road::World& world, const TilePlan& plan) : world_(world), plan_(plan) {
  FindAims();
  std::vector<Corner> here;
  for (auto at = aims_.begin(); at != aims_.end();) {
    const std::uint32_t point = at->first.first;
    here.clear();
    for (; at != aims_.end() && at->first.first == point; ++at) here.push_back(at->first);
    if (sides_W_.contains(point)) AskOnEdge(point, here);
    else AskInside(point, here);
  }
}

std::vector<double> TileHeights::Way(std::uint32_t point, double from_m, double to_m) const {
  std::vector<double> way = {from_m, to_m};
  for (auto at = corners_.lower_bound({point, 0}); at != corners_.end() && at->first.first == point; ++at) {
    for (const CornerHeight& height : at->second) {
      if (height.z_m > std::min(from_m, to_m) && height.z_m < std::max(from_m, to_m)) way.push_back(height.z_m);
    }
  }
  std::sort(way.begin(), way.end());
  way.erase(std::unique(way.begin(), way.end()), way.end());
  if (from_m > to_m) std::reverse(way.begin(), way.end());
  return way;
}

// From where each face is asked at its corners: towards its thickest triangle there.
void TileHeights::FindAims() {
  const auto points = plan_.triangles.points();
  const auto triangles = plan_.triangles.triangles();
  std::vector<std::array<Eigen::Vector2d, 3>> at(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) at[i][k] = ToWorld(plan_.key, points[triangles[i].corner[k]]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (triangles[i].across[k] != partition::Triangulation::kNone) continue;
      const Eigen::Vector2d half = 0.5 * (at[i][k] + at[i][(k + 1) % 3]);
      for (const std::size_t c : {k, (k + 1) % 3}) sides_W_[triangles[i].corner[c]].push_back(half);
    }
  }
  for (auto& [point, sides] : sides_W_) std::sort(sides.begin(), sides.end(), Before);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    const double thickness = ThicknessOf(plan_.triangles, t);
    for (std::size_t k = 0; k < 3; ++k) {
      Aim& aim = aims_[{t.corner[k], plan_.face_of[i]}];
      if (thickness > aim.thickness) aim.thickness = thickness, aim.towards_W = (at[i][0] + at[i][1] + at[i][2]) / 3.0;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (t.across[k] != partition::Triangulation::kNone) continue;
      const Eigen::Vector2d half = 0.5 * (at[i][k] + at[i][(k + 1) % 3]);
      for (const std::size_t c : {k, (k + 1) % 3}) {
        const int side = sides_W_[t.corner[c]].front() == half ? 0 : 1;
        int& on_edge = aims_[{t.corner[c], plan_.face_of[i]}].on_edge;
        on_edge = on_edge < 0 ? side : std::min(on_edge, side);
      }
    }
  }
}

std::vector<CornerHeight> TileHeights::Ask(const Eigen::Vector2d& p_W, const Eigen::Vector2d& towards_W, std::size_t count) const {
  thread_local std::vector<road::SurfacePoint> levels;
  LevelsWithin(world_, p_W, towards_W, count, levels);
  std::vector<CornerHeight> heights;
  for (std::size_t i = 0; i < count; ++i) {
    if (levels.empty()) {
      heights.push_back({});
      continue;
    }
    const road::SurfacePoint& at = levels[std::min(i, levels.size() - 1)];
    heights.push_back({RoundToStep(at.z_m), Eigen::Vector3d(-at.slope_x, -at.slope_y, 1.0).normalized(), at.inside});
  }
  return heights;
}

// Heights at one point that hardly differ become one, the middle of them.
void TileHeights::AskInside(std::uint32_t point, std::span<const Corner> here) {
  const Eigen::Vector2d p_W = ToWorld(plan_.key, plan_.triangles.points()[point]);
  std::vector<CornerHeight*> all;
  for (const Corner& corner : here) {
    auto& heights = corners_[corner] = Ask(p_W, aims_.at(corner).towards_W, plan_.faces[corner.second].levels.size());
    for (CornerHeight& height : heights) all.push_back(&height);
  }
  std::sort(all.begin(), all.end(), [](const CornerHeight* a, const CornerHeight* b) { return a->z_m < b->z_m; });
  for (std::size_t from = 0; from < all.size();) {
    std::size_t to = from + 1;
    while (to < all.size() && all[to]->z_m - all[from]->z_m <= kWelded_m) ++to;
    const double middle = RoundToStep(0.5 * (all[from]->z_m + all[to - 1]->z_m));
    for (std::size_t i = from; i < to; ++i) all[i]->z_m = middle;
    from = to;
  }
}

// Both tiles ask along the sides on their common edge and nothing else; what else meets there is welded to that.
void TileHeights::AskOnEdge(std::uint32_t point, std::span<const Corner> here) {
  const partition::GridPoint p = plan_.triangles.points()[point];
  const Eigen::Vector2d p_W = ToWorld(plan_.key, p);
  std::vector<std::vector<CornerHeight>> sides;
  for (const Eigen::Vector2d& half_W : sides_W_.at(point)) sides.push_back(Ask(p_W, IsCorner(p) ? p_W : half_W, kMostLevels));
  std::vector<CornerHeight*> all;
  for (auto& side : sides) {
    for (CornerHeight& height : side) all.push_back(&height);
  }
  std::sort(all.begin(), all.end(), [](const CornerHeight* a, const CornerHeight* b) { return a->z_m < b->z_m; });
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i]->z_m - all[i - 1]->z_m <= kWelded_m) all[i]->z_m = all[i - 1]->z_m;
  }
  for (const Corner& corner : here) {
    const Aim& aim = aims_.at(corner);
    const std::size_t count = plan_.faces[corner.second].levels.size();
    auto& heights = corners_[corner];
    if (aim.on_edge >= 0) {
      heights.assign(sides[static_cast<std::size_t>(aim.on_edge)].begin(), sides[static_cast<std::size_t>(aim.on_edge)].begin() + static_cast<std::ptrdiff_t>(count));
      continue;
    }
    heights = Ask(p_W, aim.towards_W, count);
    for (CornerHeight& height : heights) {
      for (const CornerHeight* known : all) {
        if (std::fabs(known->z_m - height.z_m) > kWelded_m) continue;
        height.z_m = known->z_m;
        break;
      }
    }
  }
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tessellation/tile_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/view/scene/tessellation/levels_at.hpp"

namespace rodeira::scene {
namespace {

bool IsCorner(const tessellation::GridPoint& p) {
  return (p.x == 0 || p.x == kTileSteps) && (p.y == 0 || p.y == kTileSteps);
}
bool Before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

}  // namespace

TileHeights::TileHeights(const road::World& world, const TilePlan& plan) : world_(world), plan_(plan) {
  const std::size_t count = plan_.triangles.points().size();
  first_.assign(count, tessellation::Triangulation::kNone);
  edge_of_.assign(count, 0);
  FindSides();
  FindAims();
  for (std::uint32_t point = 0; point < count; ++point) {
    if (edge_of_[point] != 0)
      QueryOnEdge(point);
    else
      QueryInside(point);
  }
}

std::span<const CornerHeight> TileHeights::At(std::uint32_t point, std::uint32_t face) const {
  for (std::uint32_t i = first_[point]; i != tessellation::Triangulation::kNone; i = corners_[i].next) {
    if (corners_[i].face == face) return std::span(heights_).subspan(corners_[i].first, corners_[i].count);
  }
  return {};
}

std::vector<double> TileHeights::Way(std::uint32_t point, double from_m, double to_m) const {
  std::vector<double> way = {from_m, to_m};
  for (std::uint32_t k = first_[point]; k != tessellation::Triangulation::kNone; k = corners_[k].next) {
    for (const CornerHeight& height : std::span(heights_).subspan(corners_[k].first, corners_[k].count)) {
      if (height.z_m > std::min(from_m, to_m) && height.z_m < std::max(from_m, to_m)) way.push_back(height.z_m);
    }
  }
  std::sort(way.begin(), way.end());
  way.erase(std::unique(way.begin(), way.end()), way.end());
  if (from_m > to_m) std::reverse(way.begin(), way.end());
  return way;
}

TileHeights::Corner& TileHeights::CornerOf(std::uint32_t point, std::uint32_t face) {
  for (std::uint32_t i = first_[point]; i != tessellation::Triangulation::kNone; i = corners_[i].next) {
    if (corners_[i].face == face) return corners_[i];
  }
  corners_.push_back({face, first_[point]});
  first_[point] = static_cast<std::uint32_t>(corners_.size() - 1);
  return corners_.back();
}

TileHeights::OnEdge& TileHeights::EdgeOf(std::uint32_t point) {
  if (edge_of_[point] == 0) {
    edges_.emplace_back();
    edge_of_[point] = static_cast<std::uint32_t>(edges_.size());
  }
  return edges_[edge_of_[point] - 1];
}

void TileHeights::FindSides() {
  const auto points = plan_.triangles.points();
  for (const tessellation::Triangulation::Triangle& t : plan_.triangles.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (t.across[k] != tessellation::Triangulation::kNone) continue;
      const std::array<std::uint32_t, 2> ends = {t.corner[k], t.corner[(k + 1) % 3]};
      const Eigen::Vector2d half = 0.5 * (ToWorld(plan_.key, points[ends[0]]) + ToWorld(plan_.key, points[ends[1]]));
      for (const std::uint32_t end : ends) EdgeOf(end).halves_W.push_back(half);
    }
  }
  for (OnEdge& edge : edges_) std::sort(edge.halves_W.begin(), edge.halves_W.end(), Before);
}

// From where each face is asked at its corners: towards its thickest triangle there.
void TileHeights::FindAims() {
  const auto points = plan_.triangles.points();
  const auto triangles = plan_.triangles.triangles();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    const double thickness = ThicknessOf(plan_.triangles, t);
    std::array<Eigen::Vector2d, 3> at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = ToWorld(plan_.key, points[t.corner[k]]);
    for (std::size_t k = 0; k < 3; ++k) {
      Corner& corner = CornerOf(t.corner[k], plan_.face_of[i]);
      if (thickness > corner.thickness) corner.thickness = thickness, corner.towards_W = (at[0] + at[1] + at[2]) / 3.0;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (t.across[k] != tessellation::Triangulation::kNone) continue;
      const Eigen::Vector2d half = 0.5 * (at[k] + at[(k + 1) % 3]);
      for (const std::size_t c : {k, (k + 1) % 3}) {
        const int side = EdgeOf(t.corner[c]).halves_W.front() == half ? 0 : 1;
        int& on_edge = CornerOf(t.corner[c], plan_.face_of[i]).on_edge;
        on_edge = on_edge < 0 ? side : std::min(on_edge, side);
      }
    }
  }
}

// Beside the end of a road in the air a corner's question may be answered from the deck: where another face at the
// point has more levels, a face's own are those nearest to its triangle there.
void TileHeights::QueryFace(const Eigen::Vector2d& p_W, const Corner& corner, std::size_t most) {
  if (corner.count == most) return Query(p_W, corner.towards_W, corner.count, heights_, corner.count);
  thread_local std::vector<CornerHeight> all;
  all.clear();
  Query(p_W, corner.towards_W, most, all);
  thread_local std::vector<road::SurfacePoint> within;
  LevelsAt(world_, corner.towards_W, corner.count, within);
  for (std::size_t i = 0; i < corner.count; ++i) {
    double z_m = 0.0;
    if (!within.empty()) {
      const road::SurfacePoint& own = within[std::min(i, within.size() - 1)];
      z_m = own.z_m + Eigen::Vector2d(own.slope_x, own.slope_y).dot(p_W - corner.towards_W);
    }
    heights_.push_back(*std::min_element(all.begin(), all.end(), [&](const CornerHeight& a, const CornerHeight& b) {
      return std::fabs(a.z_m - z_m) < std::fabs(b.z_m - z_m);
    }));
  }
}

std::size_t TileHeights::MostLevels(std::uint32_t point) {
  std::size_t most = 0;
  ForEachCorner(point, [&](const Corner& corner) { most = std::max(most, plan_.faces[corner.face].levels.size()); });
  return most;
}

// Adds `count` heights; where there are fewer than `least` levels the next place within is asked.
void TileHeights::Query(const Eigen::Vector2d& p_W, const Eigen::Vector2d& towards_W, std::size_t count,
                        std::vector<CornerHeight>& heights, std::size_t least) const {
  thread_local std::vector<road::SurfacePoint> levels;
  LevelsWithin(world_, p_W, towards_W, count, levels, least);
  for (std::size_t i = 0; i < count; ++i) {
    if (levels.empty()) {
      heights.push_back({});
      continue;
    }
    const road::SurfacePoint& at = levels[std::min(i, levels.size() - 1)];
    heights.push_back({RoundToStep(at.z_m), Eigen::Vector3d(-at.slope_x, -at.slope_y, 1.0).normalized(), at.inside});
  }
}

// Heights at one point that hardly differ become one, the middle of them.
void TileHeights::QueryInside(std::uint32_t point) {
  const Eigen::Vector2d p_W = ToWorld(plan_.key, plan_.triangles.points()[point]);
  const auto begin = heights_.size();
  const std::size_t most = MostLevels(point);
  ForEachCorner(point, [&](Corner& corner) {
    corner.count = static_cast<std::uint32_t>(plan_.faces[corner.face].levels.size());
    corner.first = static_cast<std::uint32_t>(heights_.size());
    QueryFace(p_W, corner, most);
  });
  if (heights_.size() - begin < 2) return;
  thread_local std::vector<CornerHeight*> all;
  all.clear();
  for (std::size_t i = begin; i < heights_.size(); ++i) all.push_back(&heights_[i]);
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
void TileHeights::QueryOnEdge(std::uint32_t point) {
  const tessellation::GridPoint p = plan_.triangles.points()[point];
  const Eigen::Vector2d p_W = ToWorld(plan_.key, p);
  thread_local std::vector<CornerHeight> sides;
  sides.clear();
  for (const Eigen::Vector2d& half_W : EdgeOf(point).halves_W)
    Query(p_W, IsCorner(p) ? p_W : half_W, kMaxLevels, sides);
  thread_local std::vector<CornerHeight*> all;
  all.clear();
  for (CornerHeight& height : sides) all.push_back(&height);
  std::sort(all.begin(), all.end(), [](const CornerHeight* a, const CornerHeight* b) { return a->z_m < b->z_m; });
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i]->z_m - all[i - 1]->z_m <= kWelded_m) all[i]->z_m = all[i - 1]->z_m;
  }
  const std::size_t most = MostLevels(point);
  ForEachCorner(point, [&](Corner& corner) {
    corner.count = static_cast<std::uint32_t>(plan_.faces[corner.face].levels.size());
    corner.first = static_cast<std::uint32_t>(heights_.size());
    if (corner.on_edge >= 0) {
      const auto own = sides.begin() + corner.on_edge * static_cast<std::ptrdiff_t>(kMaxLevels);
      heights_.insert(heights_.end(), own, own + static_cast<std::ptrdiff_t>(corner.count));
      return;
    }
    QueryFace(p_W, corner, most);
    for (CornerHeight& height : HeightsOf(corner)) {
      for (const CornerHeight* known : all) {
        if (std::fabs(known->z_m - height.z_m) > kWelded_m) continue;
        height.z_m = known->z_m;
        break;
      }
    }
  });
}

}  // namespace rodeira::scene

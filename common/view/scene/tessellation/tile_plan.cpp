// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tessellation/tile_plan.hpp"

#include <algorithm>
#include <cmath>

#include "common/view/scene/tessellation/levels_at.hpp"
#include "common/view/scene/tessellation/tile_rounds.hpp"

namespace rodeira::scene {
namespace {

using tessellation::GridPoint;
using tessellation::Triangulation;

constexpr double kTerrainsRoom_m =
    0.002;  // where the terrain's own triangles are kept no post is left out but as near to another point

class Planner {
 public:
  Planner(const road::World& world, const Land& land, const TileKey& key, int level)
      : world_(world), land_(land), level_(static_cast<std::size_t>(level)) {
    plan_.key = key;
  }

  TilePlan Plan(std::span<const tessellation::GridSegment> segments, std::span<const GridPoint> edge) {
    Triangulation& t = plan_.triangles;
    for (const GridPoint& p : edge) t.Insert(p);
    const bool decks = land_.decks.contains(plan_.key);
    for (const tessellation::GridSegment& segment : segments) {
      const std::vector<GridPoint> line = decks ? LineOverGround(world_, plan_.key, segment, static_cast<int>(level_))
                                                : std::vector<GridPoint>{segment.a, segment.b};
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const std::uint32_t a = t.Insert(line[i]), b = t.Insert(line[i + 1]);
        fixed_.push_back({a, b});
      }
    }
    for (const auto& [a, b] : fixed_) plan_.left_out += !t.Fix(a, b);
    kept_ = OwnLines() && land_.posts.HoldsAll(plan_.key);
    const bool slopes = land_.slopes.InTile(plan_.key), bare = kept_ && segments.empty() && !slopes;
    follows_slopes_ = slopes || world_.open_drive() || (world_.grid() != nullptr && level_ == 0);
    plan_.face_of = t.Faces();
    Classify();
    SpreadOverLand();
    if (bare) return std::move(plan_);  // these are SUELO's own triangles
    ConformToGround(world_, land_, static_cast<int>(level_), {kept_, follows_slopes_, decks}, plan_);
    return std::move(plan_);
  }

 private:
  // A face is what SUELO says in the middle of its thickest triangle.
  void Classify() {
    const auto triangles = plan_.triangles.triangles();
    const std::size_t count =
        plan_.face_of.empty() ? 0 : *std::max_element(plan_.face_of.begin(), plan_.face_of.end()) + 1;
    std::vector<double> thickest(count, -1.0);
    std::vector<std::uint32_t> chosen(count, 0);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const double thickness = ThicknessOf(plan_.triangles, triangles[i]);
      if (thickness > thickest[plan_.face_of[i]]) thickest[plan_.face_of[i]] = thickness, chosen[plan_.face_of[i]] = i;
    }
    plan_.faces.resize(count);
    for (std::size_t face = 0; face < count; ++face) {
      const Eigen::Vector2d p_W = ToWorld(plan_.key, MiddleOf(plan_.triangles, triangles[chosen[face]]));
      LevelsAt(world_, p_W, kMaxLevels, plan_.faces[face].levels);
      for (const road::SurfacePoint& level : plan_.faces[face].levels)
        plan_.faces[face].skins.push_back(SkinAt(world_, p_W, level));
      plan_.faces[face].land = plan_.faces[face].skins.empty() || plan_.faces[face].skins.front().land;
    }
  }

  // The lines on which land has its points: the terrain's own, or evenly spaced ones.
  struct LandLines {
    std::vector<std::int32_t> x, y;
    double room = 0.0;  // nearer to another point there is none
  };
  int EveryPost() const { return land_.EveryPost(static_cast<int>(level_)); }
  // Whether all posts of the tile are used.
  bool OwnLines() const { return land_.posts.Holds(plan_.key) && EveryPost() == 1; }
  LandLines LinesOverLand() const {
    LandLines lines;
    if (land_.posts.Holds(plan_.key))
      return {land_.posts.Columns(plan_.key, EveryPost()), land_.posts.Rows(plan_.key, EveryPost()), 1.0 / kStep_m};
    const auto every = static_cast<std::int32_t>(std::lround(kLandSpacings_m[level_] / kStep_m));
    for (std::int32_t k = every; k < kTileSteps; k += every) lines.x.push_back(k), lines.y.push_back(k);
    lines.room = 0.4 * every;
    return lines;
  }

  void SpreadOverLand() {
    const LandLines lines = LinesOverLand();
    const double room2 = lines.room * lines.room, least2 = std::pow(kTerrainsRoom_m / kStep_m, 2.0);
    std::vector<GridPoint> fresh;
    for (const std::int32_t x : lines.x) {
      for (const std::int32_t y : lines.y) {
        const GridPoint p{x, y};
        const std::uint32_t at = plan_.triangles.Find(p);
        if (!plan_.faces[plan_.face_of[at]].land) continue;
        const auto& corner = plan_.triangles.triangles()[at].corner;
        const double room = kept_ && !land_.slopes.Touch(plan_.key, p, p) ? least2 : room2;
        const bool close = std::any_of(corner.begin(), corner.end(), [&](std::uint32_t c) {
          const GridPoint q = plan_.triangles.points()[c];
          return Squared(q, p) < room;
        });
        if (!close) fresh.push_back(p);
      }
    }
    for (const GridPoint& p : fresh) plan_.triangles.Insert(p);
    PropagateFaces(plan_);
    if (kept_ || (follows_slopes_ && OwnLines())) KeepTerrainsSides();
  }

  // The terrain's own triangles stay what they are where a slope is put in beside them.
  void KeepTerrainsSides() {
    const auto points = plan_.triangles.points();
    std::vector<std::pair<GridPoint, std::uint32_t>> numbers;
    for (std::uint32_t i = 0; i < points.size(); ++i) numbers.emplace_back(points[i], i);
    std::sort(numbers.begin(), numbers.end());
    const auto number = [&](const GridPoint& p) {
      const auto found = std::lower_bound(numbers.begin(), numbers.end(), std::pair(p, std::uint32_t{0}));
      return found != numbers.end() && found->first == p ? found->second : Triangulation::kNone;
    };
    for (const auto& [from, to] : land_.posts.Sides(plan_.key)) {
      const std::uint32_t a = number(from), b = number(to);
      if (a == Triangulation::kNone || b == Triangulation::kNone) continue;
      const GridPoint middle{from.x + (to.x - from.x) / 2, from.y + (to.y - from.y) / 2};
      if (plan_.faces[plan_.face_of[plan_.triangles.Find(middle)]].land) plan_.triangles.Fix(a, b);
    }
  }

  const road::World& world_;
  const Land& land_;
  std::size_t level_;
  bool kept_ = false;  // beyond slopes the land is the terrain's own triangles
  bool follows_slopes_ = false;
  TilePlan plan_;
  std::vector<std::array<std::uint32_t, 2>> fixed_;
};

}  // namespace

double ThicknessOf(const Triangulation& triangles, const Triangulation::Triangle& triangle) {
  const auto p = triangles.points();
  double longest = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint &a = p[triangle.corner[k]], &b = p[triangle.corner[(k + 1) % 3]];
    longest = std::max(longest, Squared(a, b));
  }
  return static_cast<double>(tessellation::Turn(p[triangle.corner[0]], p[triangle.corner[1]], p[triangle.corner[2]])) /
         std::sqrt(longest);
}

TilePlan PlanTile(const road::World& world, const Land& land, const TileKey& key,
                  std::span<const tessellation::GridSegment> segments, std::span<const GridPoint> edge, int level) {
  return Planner(world, land, key, level).Plan(segments, edge);
}

}  // namespace rodeira::scene

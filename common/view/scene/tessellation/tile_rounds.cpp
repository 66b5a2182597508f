// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tessellation/tile_rounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/view/scene/tessellation/bend.hpp"
#include "common/view/scene/tessellation/levels_at.hpp"

namespace rodeira::scene {
namespace {

using tessellation::GridPoint;
using tessellation::Triangulation;

constexpr double kLongSide =
    8.0;  // times as long as the thinnest triangle is thick: such a side of a thin one is looked at
// Of points put in where the ground is not met: what bends along many triangles is met from one to the next, and each
// goes on until nothing is off. At most 76 on real files, and where cuts and fills are followed 83 in the project's
// worlds.
constexpr int kRounds = 100;
constexpr int kSlopeRounds = 100;
// A tile with so many points is not met any closer: an end where the ground of a file that is possible, and nowhere on
// earth, is steep over the whole tile. 217 000 were found where a real file banks its lanes by 45 degrees.
constexpr std::size_t kMaxPoints = 1'000'000;
// Beside a road that climbs or is banked by 45 degrees the land bends everywhere. A tile that has so many points is
// followed, where neither end of a side lies on a road's edge, as closely as the middles of the land's triangles are.
// 61 000 are the most in other real files.
constexpr std::size_t kManyPoints = 80'000;
constexpr double kMiddle = 0.7;  // of what the sides may be off: within a triangle both come together
// Cuts and fills, level by level: less than they may be off, for it is asked at few places.
constexpr std::array<BendRange, kGroundLevels> kSlopes = {
    {{0.0019, 0.01, 2.0, 0.25, 0.02}, {0.015, 0.02, 2.0}, {0.075, 0.1, 2.0}, {0.375, 0.5, 2.0}}};
// The land beside OpenDRIVE's roads, in the same way: it is steep where edges of different heights touch, and a step is
// drawn no steeper than over a side that is left as it is, four margins long.
constexpr std::array<BendRange, kGroundLevels> kVerges = {
    {{0.0023, 0.02, 4.0}, {0.015, 0.25, 4.0}, {0.075, 0.5, 4.0}, {0.375, 1.0, 4.0}}};
constexpr double kBelowStep_m = 0.2;  // below decks, where strips are narrower
constexpr double kEdgeInset_m = 1e-3;
constexpr double kBesideLine_m = 0.01;  // beside a deck's edge; its drawn line is a chord
constexpr std::size_t kMaxOnLine = 500;
// In the middle of thinner triangles nothing is put: on roads, and on land.
constexpr std::array<double, kGroundLevels> kThinnestRoad_m = {0.02, 0.5, 1.5, 4.0},
                                            kThinnestLand_m = {1.0, 2.0, 4.0, 8.0};

BendRange BelowRange(std::size_t level) {
  return {kSlopes[level].tolerance_m, kSlopes[level].margin_m, kBelowStep_m, kSlopes[level].short_m};
}

road::SurfacePoint LevelAt(const road::World& world, const Eigen::Vector2d& p_W, std::size_t level,
                           std::vector<road::SurfacePoint>& levels) {
  LevelsAt(world, p_W, level + 1, levels);
  return levels.empty() ? road::SurfacePoint{} : levels[std::min(level, levels.size() - 1)];
}

GridPoint PartOf(const GridPoint& p, const GridPoint& q, double part) {
  const auto between = [&](std::int32_t from, std::int32_t to) {
    return static_cast<std::int32_t>(std::lround(from + part * (to - from)));
  };
  return {between(p.x, q.x), between(p.y, q.y)};
}

class Rounds {
 public:
  Rounds(const road::World& world, const Land& land, int level, const Followed& what, TilePlan& plan)
      : world_(world), land_(land), level_(static_cast<std::size_t>(level)), kept_(what.kept), plan_(plan) {}

  void Run(const Followed& what) {
    for (int round = 0; HasRoom() && round < kRounds; ++round) {
      if (!MeetGround()) break;
    }
    for (int round = 0; what.slopes && HasRoom() && round < kSlopeRounds; ++round) {
      if (!MeetSlopes()) break;
    }
    for (int round = 0; what.decks && HasRoom() && round < kSlopeRounds; ++round) {
      if (!MeetBelow()) break;
    }
  }

 private:
  bool HasRoom() const { return plan_.triangles.points().size() < kMaxPoints; }

  GridPoint Middle(const Triangulation::Triangle& triangle) const { return MiddleOf(plan_.triangles, triangle); }

  struct Fresh {  // a point that is put in, and the triangle that it is put in for
    GridPoint p;
    std::uint32_t near;
  };
  std::uint32_t NumberOf(const Triangulation::Triangle& t) const {
    return static_cast<std::uint32_t>(&t - plan_.triangles.triangles().data());
  }

  // But those on the tile's edge, where a quarter of a side may lie by rounding: the neighbour does not have them.
  // False where nothing is put in.
  bool PutIn(std::vector<Fresh>& fresh) {
    std::erase_if(fresh,
                  [](const Fresh& one) { return IsOnTileEdge(one.p); });  // the neighbour's too, and settled before
    for (const Fresh& one : fresh) plan_.triangles.Insert(one.p, one.near);
    if (!fresh.empty()) PropagateFaces(plan_);
    return !fresh.empty();
  }

  double Height(const Eigen::Vector2d& p_W) {
    LevelsAt(world_, p_W, 1, levels_);
    return levels_.empty() ? 0.0 : levels_.front().z_m;
  }
  // The highest ground, and how it rises.
  struct Ground {
    double z_m = 0.0;
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  };
  Ground GroundWithin(const Eigen::Vector2d& p_W, const Eigen::Vector2d& towards_W, std::size_t level = 0,
                      std::size_t least = 1) {
    LevelsWithin(world_, p_W, towards_W, std::max(level + 1, least), levels_, least);
    if (levels_.empty()) return {};
    const road::SurfacePoint& at = levels_[std::min(level, levels_.size() - 1)];
    return {at.z_m, {at.slope_x, at.slope_y}};
  }
  double HeightWithin(const Eigen::Vector2d& p_W, const Eigen::Vector2d& towards_W) {
    return GroundWithin(p_W, towards_W).z_m;
  }

  // Puts points where a triangle, in its middle or at a quarter of a side, is too far from the ground. False where none
  // is.
  bool MeetGround() {
    std::vector<Fresh> fresh;
    const auto triangles = plan_.triangles.triangles();
    tried_.resize(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      if (tried_[i] == triangles[i].corner) continue;
      tried_[i] = triangles[i].corner;
      const bool land = plan_.faces[plan_.face_of[i]].land;
      if (land && kept_ && !SlopesTouch(triangles[i])) continue;  // it is SUELO's own
      const bool thin =
          ThicknessOf(plan_.triangles, triangles[i]) * kStep_m < (land ? kThinnestLand_m : kThinnestRoad_m)[level_];
      std::optional<Corners> corners;  // asked where they are needed
      const auto know = [&]() -> const Corners& {
        return corners ? *corners : corners.emplace(CornersOf(triangles[i], plan_.face_of[i], thin));
      };
      if (!land) CheckSides(triangles[i], thin ? kLongSide * kThinnestRoad_m[level_] : 0.0, know, fresh);
      if (!thin) CheckMiddle(triangles[i], land ? kLandTolerances_m[level_] : kMiddle * RoadTolerance(), know(), fresh);
    }
    return PutIn(fresh);
  }

  double RoadTolerance() const { return 0.75 * kRoadTolerances[level_].height_m; }

  // The triangle's corners, and their heights as they are seen from within it; of a thin one from its own middle.
  struct Corners {
    Eigen::Vector2d middle_W;
    std::array<Eigen::Vector2d, 3> at;
    std::array<double, 3> z{};
    std::array<Eigen::Vector2d, 3> slope;
  };
  Corners CornersOf(const Triangulation::Triangle& t, std::uint32_t face, bool thin, std::size_t level = 0) {
    Corners corners;
    corners.middle_W = ToWorld(plan_.key, Middle(t));
    for (std::size_t k = 0; k < 3; ++k) {
      corners.at[k] = ToWorld(plan_.key, plan_.triangles.points()[t.corner[k]]);
      const Ground ground = thin ? GroundWithin(corners.at[k], corners.middle_W, level)
                                 : CornerGround(t.corner[k], face, corners.at[k], corners.middle_W, level);
      corners.z[k] = ground.z_m, corners.slope[k] = ground.slope;
    }
    return corners;
  }

  // Of a face at one of its points, asked from within the first triangle there.
  Ground CornerGround(std::uint32_t point, std::uint32_t face, const Eigen::Vector2d& p_W,
                      const Eigen::Vector2d& towards_W, std::size_t level) {
    if (first_known_.size() < plan_.triangles.points().size())
      first_known_.resize(plan_.triangles.points().size(), Triangulation::kNone);
    for (std::uint32_t i = first_known_[point]; i != Triangulation::kNone; i = known_[i].next) {
      if (known_[i].face == face && known_[i].level == level) return known_[i].ground;
    }
    const Ground ground = GroundWithin(p_W, towards_W, level, plan_.faces[face].levels.size());
    known_.push_back({face, static_cast<std::uint32_t>(level), first_known_[point], ground});
    first_known_[point] = static_cast<std::uint32_t>(known_.size() - 1);
    return ground;
  }

  static bool IsOff(double middle_z_m, const Corners& c, double tolerance_m) {
    return std::fabs(middle_z_m - (c.z[0] + c.z[1] + c.z[2]) / 3.0) > tolerance_m;
  }
  void CheckMiddle(const Triangulation::Triangle& t, double tolerance_m, const Corners& c, std::vector<Fresh>& fresh) {
    if (IsOff(Height(c.middle_W), c, tolerance_m)) fresh.push_back({Middle(t), NumberOf(t)});
  }

  // Land is followed as roads are, along every side between two of its triangles: toes of slopes and a terrain's own
  // edges run anywhere. On a terrain at the finest level all of it, at coarser ones and on a plane where slopes may be.
  // False where nothing was put in.
  bool MeetSlopes() {
    const BendRange& slope = Slope();
    many_ = plan_.triangles.points().size() >= kManyPoints;
    const bool within_slopes = !world_.open_drive() && (level_ > 0 || kept_ || world_.grid() == nullptr);
    std::vector<Fresh> fresh;
    on_kept_.clear();
    const auto triangles = plan_.triangles.triangles();
    followed_.resize(triangles.size());
    FindBesideRoad();
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      if (followed_[i] == triangles[i].corner) continue;
      followed_[i] = triangles[i].corner;
      if (!plan_.faces[plan_.face_of[i]].land || (within_slopes && !SlopesTouch(triangles[i]))) continue;
      const std::size_t before = fresh.size() + on_kept_.size();
      const Corners corners = CornersOf(triangles[i], plan_.face_of[i], false);
      FollowSides(triangles[i], plan_.face_of[i], corners, fresh);
      // What bends within a triangle and crosses none of its sides.
      if (fresh.size() + on_kept_.size() > before ||
          ThicknessOf(plan_.triangles, triangles[i]) * kStep_m < slope.margin_m)
        continue;
      const road::SurfacePoint middle = world_.At(corners.middle_W.x(), corners.middle_W.y());
      if (middle.inside && IsOff(middle.z_m, corners, many_ ? kLandTolerances_m[level_] : slope.tolerance_m))
        fresh.push_back({Middle(triangles[i]), i});
    }
    for (const OnKept& on : on_kept_) {
      plan_.triangles.Release(on.a, on.b);
      fresh.push_back({on.bend, on.near});
    }
    PutIn(fresh);
    // Sides are kept again once every triangle has its face: those that a side parts from the others may all be new.
    for (const OnKept& on : on_kept_) {
      const std::uint32_t at = plan_.triangles.Insert(on.bend);
      plan_.triangles.Fix(on.a, at);
      plan_.triangles.Fix(at, on.b);
    }
    return !fresh.empty();
  }

  // The points on roads' edges.
  void FindBesideRoad() {
    beside_road_.assign(plan_.triangles.points().size(), false);
    const auto triangles = plan_.triangles.triangles();
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      if (plan_.faces[plan_.face_of[i]].land) continue;
      for (const std::uint32_t corner : triangles[i].corner) beside_road_[corner] = true;
    }
  }

  // What lies below decks is followed as slopes are: where a bridge begins, land comes up to it. False where nothing
  // was put in.
  bool MeetBelow() {
    std::vector<Fresh> fresh;
    const auto triangles = plan_.triangles.triangles();
    below_.resize(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const Face& face = plan_.faces[plan_.face_of[i]];
      if (below_[i] == triangles[i].corner) continue;
      below_[i] = triangles[i].corner;
      for (std::size_t level = 1; level < face.levels.size(); ++level) {
        const std::size_t before = fresh.size();
        const Corners corners = CornersOf(triangles[i], plan_.face_of[i], false, level);
        FollowBelow(triangles[i], corners, level, fresh);
        if (fresh.size() > before || ThicknessOf(plan_.triangles, triangles[i]) * kStep_m < kSlopes[level_].margin_m)
          continue;
        if (IsOff(LevelAt(corners.middle_W, level).z_m, corners, kSlopes[level_].tolerance_m))
          fresh.push_back({Middle(triangles[i]), i});
      }
    }
    return PutIn(fresh);
  }

  const BendRange& Slope() const { return world_.open_drive() ? kVerges[level_] : kSlopes[level_]; }
  BendRange Below() const { return BelowRange(level_); }
  road::SurfacePoint LevelAt(const Eigen::Vector2d& p_W, std::size_t level) {
    return scene::LevelAt(world_, p_W, level, levels_);
  }

  void FollowBelow(const Triangulation::Triangle& t, const Corners& c, std::size_t level, std::vector<Fresh>& fresh) {
    const auto points = plan_.triangles.points();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t n = (k + 1) % 3;
      if (t.fixed[k] || t.across[k] == Triangulation::kNone || t.corner[k] > t.corner[n])
        continue;  // lines have their points
      const auto part = BendBetween([&](const Eigen::Vector2d& p_W) { return LevelAt(p_W, level); }, c.at[k], c.z[k],
                                    c.at[n], c.z[n], Below());
      if (!part) continue;
      const GridPoint bend = PartOf(points[t.corner[k]], points[t.corner[n]], *part);
      fresh.push_back({bend, NumberOf(t)});
    }
  }

  bool SlopesTouch(const Triangulation::Triangle& t) const {
    const auto points = plan_.triangles.points();
    GridPoint low = points[t.corner[0]], high = low;
    for (const std::uint32_t corner : t.corner) {
      low = {std::min(low.x, points[corner].x), std::min(low.y, points[corner].y)};
      high = {std::max(high.x, points[corner].x), std::max(high.y, points[corner].y)};
    }
    return land_.slopes.Touch(plan_.key, low, high);
  }

  void FollowSides(const Triangulation::Triangle& t, std::uint32_t face, const Corners& c, std::vector<Fresh>& fresh) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t n = (k + 1) % 3;
      if (t.across[k] == Triangulation::kNone) continue;
      const bool kept = t.fixed[k] && plan_.face_of[t.across[k]] == face, ends = t.fixed[k] && !kept;
      if (!ends && t.corner[k] > t.corner[n]) continue;
      Eigen::Vector2d p_W = c.at[k], q_W = c.at[n];
      if (ends) {  // the terrain's end, seen from within; roads' edges have their points
        if (!plan_.faces[plan_.face_of[t.across[k]]].land) continue;
        const Eigen::Vector2d within = kEdgeInset_m * (c.middle_W - 0.5 * (p_W + q_W)).normalized();
        p_W += within, q_W += within;
      }
      const Eigen::Vector2d way = c.at[n] - c.at[k];
      const double rise_m = c.z[n] - c.z[k];
      const bool straight_ends = std::fabs(c.slope[k].dot(way) - rise_m) <= Slope().tolerance_m &&
                                 std::fabs(c.slope[n].dot(way) - rise_m) <= Slope().tolerance_m;
      if (!ends && KnownStraight(t.corner[k], t.corner[n])) continue;
      BendRange range = Slope();
      if (!beside_road_[t.corner[k]] && !beside_road_[t.corner[n]]) {
        range.ends_m = 0.0;
        if (many_) range.tolerance_m = kLandTolerances_m[level_];
      }
      const auto part = BendBetween(highest_, p_W, c.z[k], q_W, c.z[n], range, straight_ends);
      if (!part && !ends) SetStraight(t.corner[k], t.corner[n]);
      if (!part) continue;
      const GridPoint p = plan_.triangles.points()[t.corner[k]], q = plan_.triangles.points()[t.corner[n]];
      const auto between = [&](std::int32_t from, std::int32_t to) {
        return static_cast<std::int32_t>(std::lround(from + *part * (to - from)));
      };
      const GridPoint bend{between(p.x, q.x), between(p.y, q.y)};
      if (IsOnTileEdge(bend)) continue;  // nor is its kept side cut
      if (kept)
        on_kept_.push_back({bend, t.corner[k], t.corner[n], NumberOf(t)});
      else
        fresh.push_back({bend, NumberOf(t)});
    }
  }

  // Between two points of one face the ground is the same whichever triangle asks, and a side outlives its triangles.
  bool KnownStraight(std::uint32_t a, std::uint32_t b) const {
    for (std::uint32_t i = a < first_straight_.size() ? first_straight_[a] : Triangulation::kNone;
         i != Triangulation::kNone; i = straight_[i].next) {
      if (straight_[i].to == b) return true;
    }
    return false;
  }
  void SetStraight(std::uint32_t a, std::uint32_t b) {
    if (first_straight_.size() < plan_.triangles.points().size())
      first_straight_.resize(plan_.triangles.points().size(), Triangulation::kNone);
    straight_.push_back({b, first_straight_[a]});
    first_straight_[a] = static_cast<std::uint32_t>(straight_.size() - 1);
  }

  // An S, as two vertical curves make it, is met in its middle: its quarters are looked at too.
  template <class Know>
  void CheckSides(const Triangulation::Triangle& t, double longer_m, const Know& know, std::vector<Fresh>& fresh) {
    const auto points = plan_.triangles.points();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t n = (k + 1) % 3;
      if (t.fixed[k] || t.across[k] == Triangulation::kNone || t.corner[k] > t.corner[n]) continue;
      const GridPoint &p = points[t.corner[k]], &q = points[t.corner[n]];
      if (std::sqrt(Squared(p, q)) * kStep_m <= longer_m) continue;
      const Corners& c = know();
      for (const int quarter : {2, 1, 3}) {
        const double part = 0.25 * quarter;
        const double z = HeightWithin(c.at[k] + part * (c.at[n] - c.at[k]), c.middle_W);
        if (std::fabs(z - (c.z[k] + part * (c.z[n] - c.z[k]))) <= RoadTolerance()) continue;
        fresh.push_back({{p.x + (q.x - p.x) * quarter / 4, p.y + (q.y - p.y) * quarter / 4}, NumberOf(t)});
        if (quarter == 2) break;
      }
    }
  }

  const road::World& world_;
  const Land& land_;
  std::size_t level_;
  bool kept_;
  TilePlan& plan_;
  GroundAt highest_ = [this](const Eigen::Vector2d& p_W) { return world_.At(p_W.x(), p_W.y()); };
  std::vector<std::array<std::uint32_t, 3>> tried_, followed_, below_;
  struct OnKept {
    GridPoint bend;
    std::uint32_t a, b;  // the ends of the side that is kept
    std::uint32_t near;  // its triangle
  };
  std::vector<OnKept> on_kept_;
  std::vector<bool> beside_road_;  // by point
  bool many_ = false;              // kManyPoints
  struct Known {
    std::uint32_t face;
    std::uint32_t level;
    std::uint32_t next;  // of the same point
    Ground ground;
  };
  std::vector<Known> known_;
  std::vector<std::uint32_t> first_known_;  // by point
  struct Straight {                         // a side of the land along which nothing bends
    std::uint32_t to, next;                 // its other end; of the same point
  };
  std::vector<Straight> straight_;
  std::vector<std::uint32_t> first_straight_;  // by point
  std::vector<road::SurfacePoint> levels_;
};

}  // namespace

GridPoint MiddleOf(const Triangulation& triangles, const Triangulation::Triangle& triangle) {
  const auto p = triangles.points();
  const auto mean = [](std::int32_t a, std::int32_t b, std::int32_t c) {
    return static_cast<std::int32_t>((static_cast<std::int64_t>(a) + b + c) / 3);
  };
  const GridPoint &a = p[triangle.corner[0]], &b = p[triangle.corner[1]], &c = p[triangle.corner[2]];
  return {mean(a.x, b.x, c.x), mean(a.y, b.y, c.y)};
}

void PropagateFaces(TilePlan& plan) {
  for (std::size_t i = plan.face_of.size(); i < plan.triangles.triangles().size(); ++i)
    plan.face_of.push_back(plan.face_of[plan.triangles.CutFrom(static_cast<std::uint32_t>(i))]);
}

void ConformToGround(const road::World& world, const Land& land, int level, const Followed& followed, TilePlan& plan) {
  Rounds(world, land, level, followed, plan).Run(followed);
}

std::vector<GridPoint> LineOverGround(const road::World& world, const TileKey& key,
                                      const tessellation::GridSegment& segment, int level) {
  const BendRange below = BelowRange(static_cast<std::size_t>(level));
  std::vector<road::SurfacePoint> levels;
  std::vector<GridPoint> line = {segment.a, segment.b};
  const Eigen::Vector2d along = ToWorld(key, segment.b) - ToWorld(key, segment.a);
  for (const double side : {kBesideLine_m, -kBesideLine_m}) {
    const Eigen::Vector2d aside = side * Eigen::Vector2d(-along.y(), along.x()).normalized();
    LevelsAt(world, ToWorld(key, segment.a) + 0.5 * along + aside, kMaxLevels, levels);
    const std::size_t count = levels.size();
    for (std::size_t at = 1; at < count; ++at) {
      const GroundAt ground = [&](const Eigen::Vector2d& p_W) { return LevelAt(world, p_W + aside, at, levels); };
      for (std::size_t i = 0; i + 1 < line.size() && line.size() < kMaxOnLine;) {
        const Eigen::Vector2d a_W = ToWorld(key, line[i]), b_W = ToWorld(key, line[i + 1]);
        const auto part = BendBetween(ground, a_W, ground(a_W).z_m, b_W, ground(b_W).z_m, below);
        const GridPoint bend = part ? PartOf(line[i], line[i + 1], *part) : line[i];
        if (!part || bend == line[i] || bend == line[i + 1] || IsOnTileEdge(bend))
          ++i;
        else
          line.insert(line.begin() + static_cast<std::ptrdiff_t>(i) + 1, bend);
      }
    }
  }
  return line;
}

}  // namespace rodeira::scene

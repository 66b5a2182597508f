// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tessellation/levels_at.hpp"

#include <algorithm>
#include <cmath>

#include "common/world/network/network.hpp"
#include "common/world/road/built_ground.hpp"
#include "common/world/road/network_land.hpp"

namespace rodeira::scene {
namespace {

// SUELO below a height is asked with hints that lie deeper and deeper: the nearest road to a hint just below a bridge
// is the bridge itself.
constexpr double kDeeper_m[] = {2.6, 4.6, 8.0};
constexpr double kCornerDistance_m = 0.02;    // from a corner to the place where its face is sampled
constexpr double kMaxCornerDistance_m = 0.5;  // the same at most, where the face needs it
constexpr double kMaxGroundSlope = 4.0;       // slopes beyond this are a step's, not the ground's
constexpr double kOnDeck_m = 0.3;             // so much may be laid on a deck
constexpr double kSameLevel_m = 1e-6;

// Whether SUELO has no surface below its highest one, so that no hint finds more: on terrain of its own, where no
// road is, or where the one that stands on the ground is what it answers from.
bool IsAlone(const road::World& world, const Eigen::Vector2d& p_W, double z_m) {
  if (world.network() == nullptr || world.open_drive()) return false;
  thread_local std::vector<network::Surfacing> surfaces;
  world.network()->Surfaces(p_W.x(), p_W.y(), surfaces);
  if (surfaces.empty()) return true;
  const network::Place& place = surfaces[0].place;
  const network::RoadSpec& road = world.network()->roads()[place.lane.road].spec();
  const bool answers = place.lane.lane != 0 && std::fabs(surfaces[0].sample.p_W.z() - z_m) < kLevelApart_m;
  return surfaces.size() == 1 && answers && road.junction.empty() && !road::IsExempt(road, place.s_m);
}

// Whether a height is a deck's: there the land below comes up to it where the bridge begins, and is a level of its own
// however near it is.
bool IsDeck(const road::World& world, const Eigen::Vector2d& p_W, double z_m) {
  if (world.network() == nullptr) return false;
  thread_local std::vector<network::Surfacing> surfaces;
  world.network()->Surfaces(p_W.x(), p_W.y(), surfaces);
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const network::Surfacing& surfacing) {
    const network::Place& place = surfacing.place;
    if (place.lane.lane == 0 || !(std::fabs(surfacing.sample.p_W.z() - z_m) < kOnDeck_m)) return false;
    if (world.land() != nullptr) return world.land()->IsOnDeck(place.lane.road, place.s_m);
    return road::IsOnBridge(world.network()->roads()[place.lane.road].spec(), place.s_m);
  });
}

// The ground far from a road goes on at the height of its edge. Its section would climb on for as far as the place is
// away: a bank of 3 % by 3 m at 100 m, where the land beside the road ends.
double BesideLanes(const network::Network& network, const network::Place& place) {
  const network::Road& road = network.roads()[place.lane.road];
  if (road.flat() || place.distance_m == 0.0) return place.z_m;
  double right_m, left_m;
  road.SectionAt(place.s_m).Bounds(road.spec().lane_offset, place.s_m, place.s_m, right_m, left_m);
  if (!(right_m <= left_m)) return place.z_m;
  return road.Surface(place.s_m, std::clamp(place.t_m, right_m, left_m)).p_W.z();
}

}  // namespace

void LevelsAt(const road::World& world, const Eigen::Vector2d& p_W, std::size_t most,
              std::vector<road::SurfacePoint>& levels) {
  levels.clear();
  road::SurfacePoint top = world.At(p_W.x(), p_W.y());
  if (!top.inside) {
    if (world.network() == nullptr) return;
    const auto place = world.network()->Locate(p_W.x(), p_W.y());
    if (!place || !std::isfinite(place->z_m)) return;
    top = {BesideLanes(*world.network(), *place), 0.0, 0.0, 0.0, ground::Surface::kGrass, false};
    levels.push_back(top);
    return;
  }
  levels.push_back(top);
  if (most > 1 && IsAlone(world, p_W, top.z_m)) return;
  while (levels.size() < most) {
    const double z = levels.back().z_m;
    bool deeper = false;
    if (IsDeck(world, p_W, z)) {
      const road::SurfacePoint below = world.At(p_W.x(), p_W.y(), z - ground::kMaxAboveHint_m - kSameLevel_m);
      if (!below.inside || !(below.z_m < z - kSameLevel_m)) break;
      levels.push_back(below);
      continue;
    }
    for (const double down : kDeeper_m) {
      const road::SurfacePoint below = world.At(p_W.x(), p_W.y(), z - down);
      if (!below.inside || !(below.z_m < z - kLevelApart_m)) continue;
      levels.push_back(below);
      deeper = true;
      break;
    }
    if (!deeper) break;
  }
}

void LevelsWithin(const road::World& world, const Eigen::Vector2d& p_W, const Eigen::Vector2d& towards_W,
                  std::size_t most, std::vector<road::SurfacePoint>& levels, std::size_t least) {
  const Eigen::Vector2d way = towards_W - p_W;
  const double length = way.norm();
  double off_m = std::min(kCornerDistance_m, 0.3 * length);
  Eigen::Vector2d off = length > 0.0 ? Eigen::Vector2d(off_m / length * way) : Eigen::Vector2d::Zero();
  LevelsAt(world, p_W + off, most, levels);
  while (off_m > 0.0 && !levels.empty() && levels.size() < std::min(least, most) &&
         2.0 * off_m <= std::min(length, kMaxCornerDistance_m)) {
    off_m *= 2.0, off *= 2.0;
    LevelsAt(world, p_W + off, most, levels);
  }
  for (road::SurfacePoint& level : levels) {
    const Eigen::Vector2d slope(level.slope_x, level.slope_y);
    if (slope.norm() <= kMaxGroundSlope) level.z_m -= slope.dot(off);
  }
}

}  // namespace rodeira::scene

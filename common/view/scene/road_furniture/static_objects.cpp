// SPDX-License-Identifier: Apache-2.0
// What stands where, and rails and walls along the road.
#include "common/view/scene/road_furniture/static_objects.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/view/scene/tessellation/levels_at.hpp"
#include "common/view/scene/tessellation/tile_plan.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kChord_m = 0.02;  // how far a rail's piece may leave its bend
constexpr double kBeforeBoard_m = 0.01;

// SUELO's ground nearest to a height; that height itself where there is none.
double GroundHeightAt(const road::World& world, const Vector3d& p_W) {
  thread_local std::vector<road::SurfacePoint> levels;
  LevelsAt(world, p_W.head<2>(), kMaxLevels, levels);
  double z = p_W.z();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].inside && (i == 0 || std::fabs(levels[i].z_m - p_W.z()) < std::fabs(z - p_W.z()))) z = levels[i].z_m;
  }
  return z;
}

TileKey TileAt(const Vector2d& p_W) {
  const WorldStep at = ToSteps(p_W);
  return {TileOf(at.x), TileOf(at.y)};
}

}  // namespace

StaticObjects::StaticObjects(const road::World& world, ModelIsThere is_there) : is_there_(std::move(is_there)) {
  RODEIRA_ASSERT(world.network() != nullptr);
  const network::Furniture furniture = network::PlaceFurniture(*world.network());
  for (const network::Placed& placed : furniture.things) AddThing(world, placed);
  for (const network::PlacedRun& run : furniture.runs) AddRun(world, run);
  for (const network::TubePiece& piece : network::PlaceTubes(*world.network())) {
    tiles_[TileAt(0.25 * (piece.right_W[0] + piece.right_W[1] + piece.left_W[0] + piece.left_W[1]).head<2>())]
        .tubes.push_back(piece);
  }
  if (world.props() != nullptr) AddProps(world, *world.props());
}

void StaticObjects::Keep(Thing thing) {
  const TileKey key = TileAt(thing.stand.foot_W.head<2>());
  tiles_[key].things.push_back(std::move(thing));
}

void StaticObjects::KeepRail(const RailPiece& piece) {
  tiles_[TileAt(0.5 * (piece.foot_W[0] + piece.foot_W[1]).head<2>())].rails.push_back(piece);
}

Thing StaticObjects::ThingAt(const network::Placed& placed, const Vector3d& foot_W) {
  Thing thing;
  thing.stand = Stand::At(foot_W, placed.heading_rad);
  thing.above_m = placed.z_offset_m;
  thing.length_m = placed.length_m, thing.width_m = placed.width_m, thing.height_m = placed.height_m,
  thing.radius_m = placed.radius_m;
  return thing;
}

void StaticObjects::AddThing(const road::World& world, const network::Placed& placed) {
  const network::Road& road = world.network()->roads()[placed.road];
  Thing thing = ThingAt(placed, {placed.foot_W.x(), placed.foot_W.y(), GroundHeightAt(world, placed.foot_W)});
  if (placed.z_W_m) thing.above_m = *placed.z_W_m - thing.stand.foot_W.z();
  // x looks to the reader, whose left lies on the side of -y; the sign lies a little before its board.
  if (placed.signal != nullptr && !placed.signal->board.empty())
    thing.stand.foot_W = thing.stand.ToWorld({kBeforeBoard_m, -placed.signal->board_left_m, 0.0});
  if (placed.signal != nullptr)
    AddSignal(road, placed, std::move(thing));
  else
    AddObject(&road, placed, std::move(thing));
}

void StaticObjects::AddRun(const road::World& world, const network::PlacedRun& run) {
  const network::Road& road = world.network()->roads()[run.road];
  const double length = run.to_s_m - run.from_s_m;
  const network::Object& object = *run.object;
  if (network::IsFlat(object)) return;
  const bool rail = object.subtype == "guard_rail" || object.subtype == "guardRail" || object.subtype == "railing" ||
                    object.type == "railing";
  const int pieces =
      std::max(1, static_cast<int>(std::ceil(length / run.Step(road, kMaxRailPiece_m, kChord_m) - 1e-9)));
  RailPiece piece;
  piece.wall = !rail;
  for (int i = 0; i <= pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    const auto mix = [share](double a, double b) { return a + share * (b - a); };
    piece.foot_W[0] = piece.foot_W[1], piece.left_W[0] = piece.left_W[1], piece.height_m[0] = piece.height_m[1],
    piece.width_m[0] = piece.width_m[1];
    const auto [on_road, left_W] = run.At(road, share);
    piece.foot_W[1] = {on_road.x(), on_road.y(), GroundHeightAt(world, on_road) + mix(run.z_start_m, run.z_end_m)};
    piece.left_W[1] = left_W;
    const double height = mix(run.height_start_m, run.height_end_m), width = mix(run.width_start_m, run.width_end_m);
    piece.height_m[1] = height > kFlatThing_m ? height : rail ? 0.75 : 1.0;
    piece.width_m[1] = width > 0.0 ? width : 0.3;
    if (i > 0) KeepRail(piece);
  }
}

}  // namespace rodeira::scene

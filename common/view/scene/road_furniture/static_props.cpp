// SPDX-License-Identifier: Apache-2.0
// What stands at no road, on SUELO's highest ground.
#include <algorithm>
#include <cmath>

#include "common/view/scene/road_furniture/static_objects.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d OnGround(const road::World& world, const Vector2d& p_W) {
  const road::SurfacePoint at = world.At(p_W.x(), p_W.y());
  return {p_W.x(), p_W.y(), at.inside ? at.z_m : 0.0};
}

// At right angles to the line at a corner of it, halfway between its two pieces.
Vector2d LeftAt(const std::vector<Vector2d>& line, std::size_t corner) {
  const Vector2d before = corner > 0 ? Vector2d((line[corner] - line[corner - 1]).normalized()) : Vector2d::Zero();
  const Vector2d after =
      corner + 1 < line.size() ? Vector2d((line[corner + 1] - line[corner]).normalized()) : Vector2d::Zero();
  const Vector2d along = before + after;  // where the line turns back it is nothing
  const Vector2d way = along.norm() > 1e-6 ? along.normalized() : before;
  return {-way.y(), way.x()};
}

}  // namespace

void StaticObjects::AddProps(const road::World& world, const network::Props& props) {
  for (const network::Props::Placement& each : props.placements) {
    const network::Placed placed = network::PlaceProp(props, each, OnGround(world, each.at_W));
    AddObject(nullptr, placed, ThingAt(placed, placed.foot_W));
  }
  for (const network::Props::Run& run : props.runs) {
    const network::Object& object = props.objects[run.object];
    RailPiece piece;
    piece.wall = object.subtype != "guard_rail";
    piece.height_m.fill(object.height_m), piece.width_m.fill(object.width_m);
    const auto stand_at = [&](const Vector2d& p, const Vector2d& left) {
      piece.foot_W[0] = piece.foot_W[1], piece.left_W[0] = piece.left_W[1];
      piece.foot_W[1] = OnGround(world, p) + object.z_offset_m * Vector3d::UnitZ(), piece.left_W[1] = left;
    };
    stand_at(run.points_W[0], LeftAt(run.points_W, 0));
    for (std::size_t i = 1; i < run.points_W.size(); ++i) {
      const Vector2d way = run.points_W[i] - run.points_W[i - 1];
      const Vector2d left = Vector2d(-way.y(), way.x()).normalized();
      const double pieces = std::max(1.0, std::ceil(way.norm() / kMaxRailPiece_m - 1e-9));
      for (double k = 1.0; k <= pieces; k += 1.0) {
        stand_at(run.points_W[i - 1] + k / pieces * way, k < pieces ? left : LeftAt(run.points_W, i));
        KeepRail(piece);
      }
    }
  }
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "nodes/vehicle/obstacle_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rodeira::nodes {
namespace {

using Eigen::Vector3d;

constexpr double kCell_m = 16.0;
constexpr double kLow_m = 0.3;    // what is lower is driven over
constexpr double kBelow_m = 1.0;  // of the ground: what stands on it is founded
constexpr double kTall_m = 2.0;
constexpr double kHangs_m = 2.0;  // over the ground: that does not stand on it
constexpr double kTrunk_m = 0.3;
constexpr double kPiece_m = 10.0;  // of a rail, at most
constexpr double kChord_m = 0.02;  // between a piece and the bend that it stands for
constexpr double kEdge_m = 0.2;    // thickness of an outline's walls

bool IsOneOf(const std::string& word, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* each) { return word == each; });
}

bool IsTree(const network::Object& object) { return object.type == "tree" || object.subtype == "tree"; }

bool GivesWay(const network::Object& object) {
  return IsOneOf(object.subtype, {"bush", "post", "permanentDelineator"}) ||
         IsOneOf(object.type, {"bush", "vegetation", "guide-post"});
}

// It is a body even where the file does not say how high it is.
bool IsBody(const network::Object& object) {
  return IsOneOf(object.type, {"pole", "rail-pole", "barrier", "building", "obstacle", "streetLamp"});
}

// SUELO's height beside the road, the road's own where that is not known.
Vector3d OnGround(const road::World& world, const Vector3d& on_road) {
  const road::SurfacePoint ground = world.At(on_road.x(), on_road.y(), on_road.z());
  return {on_road.x(), on_road.y(), ground.inside ? ground.z_m : on_road.z()};
}

}  // namespace

ObstacleMap::ObstacleMap(const road::World& world, double reach_m) : reach_m_(reach_m) {
  if (world.network() == nullptr) return;
  const network::Furniture furniture = network::PlaceFurniture(*world.network());
  for (const network::Placed& placed : furniture.things) {
    if (placed.object != nullptr) AddThing(world, placed);
  }
  for (const network::PlacedRun& run : furniture.runs) AddRun(world, run);
  for (const network::TubePiece& piece : network::PlaceTubes(*world.network())) AddTube(piece);
  if (world.props() != nullptr) AddProps(world, *world.props());
}

void ObstacleMap::AddThing(const road::World& world, const network::Placed& placed) {
  AddBody(placed, OnGround(world, placed.foot_W) + placed.z_offset_m * Vector3d::UnitZ(),
          &world.network()->roads()[placed.road]);
}

// On SUELO's highest ground.
void ObstacleMap::AddProps(const road::World& world, const network::Props& props) {
  const auto on_ground = [&](const Eigen::Vector2d& p_W, const network::Object& object) {
    const road::SurfacePoint ground = world.At(p_W.x(), p_W.y());
    return Vector3d(p_W.x(), p_W.y(), (ground.inside ? ground.z_m : 0.0) + object.z_offset_m);
  };
  for (const network::Props::Placement& thing : props.placements) {
    const Vector3d foot = on_ground(thing.at_W, props.objects[thing.object]);
    AddBody(network::PlaceProp(props, thing, foot), foot, nullptr);
  }
  for (const network::Props::Run& run : props.runs) {
    const network::Object& object = props.objects[run.object];
    Vector3d last = on_ground(run.points_W[0], object);
    for (std::size_t i = 1; i < run.points_W.size(); ++i) {
      const Eigen::Vector2d way = run.points_W[i] - run.points_W[i - 1];
      const double pieces = std::max(1.0, std::ceil(way.norm() / kPiece_m - 1e-9));
      for (double k = 1.0; k <= pieces; k += 1.0) {
        const Vector3d foot = on_ground(run.points_W[i - 1] + k / pieces * way, object);
        AddWall(object.id, last, foot, object.width_m > 0.0 ? object.width_m : 0.3, object.height_m);
        last = foot;
      }
    }
  }
}

void ObstacleMap::AddBody(const network::Placed& placed, const Vector3d& foot, const network::Road* road) {
  const network::Object& object = *placed.object;
  if (GivesWay(object) || network::IsFlat(object)) return;
  const bool stands = placed.z_offset_m < kHangs_m;
  if (IsTree(object)) return AddBox(object.id, foot, placed.heading_rad, {kTrunk_m, kTrunk_m, kTall_m}, stands);
  const Eigen::Rotation2Dd turned(placed.heading_rad);
  if (!object.skeleton.empty()) return AddSkeleton(placed, foot, road);
  for (const network::Outline& outline : object.outlines) {
    std::vector<Vector3d> feet;
    double height = placed.height_m;
    for (const network::Corner& corner : outline.corners) {
      height = std::max(height, corner.height_m);
      const Eigen::Vector2d local = turned * Eigen::Vector2d(corner.first_m, corner.second_m);
      feet.push_back(corner.local || road == nullptr ? Vector3d(foot + Vector3d(local.x(), local.y(), corner.dz_m))
                                                     : Vector3d(road->Surface(corner.first_m, corner.second_m).p_W +
                                                                corner.dz_m * Vector3d::UnitZ()));
    }
    if (height < kLow_m || !stands) continue;
    for (std::size_t i = 0; i + 1 < feet.size(); ++i) AddWall(object.id, feet[i], feet[i + 1], kEdge_m, height);
    if (outline.closed && feet.size() > 2) AddWall(object.id, feet.back(), feet.front(), kEdge_m, height);
  }
  if (!object.outlines.empty() || (placed.height_m < kLow_m && !IsBody(object))) return;
  const bool is_building = object.type == "building";
  const auto usual = [&](double said, double default_value) {
    return said > 0.0 ? said : placed.radius_m > 0.0 ? 2.0 * placed.radius_m : default_value;
  };
  AddBox(object.id, foot, placed.heading_rad,
         {usual(placed.length_m, is_building ? 12.0 : 0.12), usual(placed.width_m, is_building ? 9.0 : 0.12),
          std::max(placed.height_m, kLow_m)},
         stands);
}

// Each of its bars is a box along it, seen from above, between its heights: what hangs high is passed under.
void ObstacleMap::AddSkeleton(const network::Placed& placed, const Vector3d& foot, const network::Road* road) {
  const Eigen::Rotation2Dd turned(placed.heading_rad);
  const auto at = [&](const network::SkeletonPoint& point) -> Vector3d {
    if (!point.local && road != nullptr)
      return road->Surface(point.first_m, point.second_m).p_W + point.dz_m * Vector3d::UnitZ();
    const Eigen::Vector2d local = turned * Eigen::Vector2d(point.first_m, point.second_m);
    return foot + Vector3d(local.x(), local.y(), point.dz_m);
  };
  const auto half = [](const network::SkeletonPoint& point) {
    return std::max(point.radius_m, 0.5 * std::max(point.width_m, point.length_m));
  };
  for (const network::SkeletonLine& line : placed.object->skeleton) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Vector3d from = at(line[i - 1]), to = at(line[i]), way = to - from;
      const double thick = std::max(half(line[i - 1]), half(line[i]));
      const bool upright = way.head<2>().norm() <= 0.01 * std::fabs(way.z());
      const double heading = way.head<2>().norm() > 0.0 ? std::atan2(way.y(), way.x()) : placed.heading_rad;
      Vector3d low = 0.5 * (from + to);
      low.z() = std::min(from.z(), to.z()) - (upright ? 0.0 : thick);
      const double high = std::max(from.z(), to.z()) + (upright ? 0.0 : thick) - low.z();
      const double ground = foot.z() - placed.z_offset_m;
      const bool stands = low.z() - ground < kHangs_m;
      if (low.z() + high - ground >= kLow_m)
        AddBox(placed.object->id, low, heading, {way.head<2>().norm() + 2.0 * thick, 2.0 * thick, high}, stands);
    }
  }
}

void ObstacleMap::AddRun(const road::World& world, const network::PlacedRun& run) {
  if (GivesWay(*run.object) || network::IsFlat(*run.object)) return;
  const network::Road& road = world.network()->roads()[run.road];
  const double length = run.to_s_m - run.from_s_m;
  double step = kPiece_m;
  for (double s = run.from_s_m; !run.straight && s <= run.to_s_m; s += 1.0) {
    const double bend = std::fabs(road.axis().Evaluate(s).curvature_1pm);
    if (bend > 0.0) step = std::min(step, std::max(0.5, std::sqrt(8.0 * kChord_m / bend)));
  }
  const int pieces = std::max(1, static_cast<int>(std::ceil(length / step - 1e-9)));
  Vector3d last = Vector3d::Zero();
  for (int i = 0; i <= pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    const auto mix = [share](double a, double b) { return a + share * (b - a); };
    const Vector3d foot =
        OnGround(world, run.At(road, share).p_W) + mix(run.z_start_m, run.z_end_m) * Vector3d::UnitZ();
    const double width = mix(run.width_start_m, run.width_end_m), height = mix(run.height_start_m, run.height_end_m);
    if (i > 0 && (height >= kLow_m || IsBody(*run.object)))
      AddWall(run.object->id, last, foot, width > 0.0 ? width : 0.3, height);
    last = foot;
  }
}

void ObstacleMap::AddTube(const network::TubePiece& piece) {
  for (const double side : {-1.0, 1.0}) {
    if (!(side < 0.0 ? piece.right_wall : piece.left_wall)) continue;
    const std::array<Vector3d, 2>& edge = side < 0.0 ? piece.right_W : piece.left_W;
    const auto beside = [&](std::size_t end, double out_m) -> Vector3d {
      const Eigen::Vector2d left = piece.LeftAt(end);
      return edge[end] + side * out_m * Vector3d(left.x(), left.y(), 0.0);
    };
    constexpr double wall_m = 0.5 * network::kTubeWall_m - network::kTubeInside_m;
    const double height = std::min(piece.ceiling_m[0], piece.ceiling_m[1]);
    AddWall(piece.structure->id, beside(0, wall_m), beside(1, wall_m), network::kTubeWall_m, height);
    for (const std::size_t end : {0, 1}) {
      if (!piece.portal[end]) continue;
      const Vector3d middle = beside(end, 0.5 * network::kPortalWing_m),
                     along = (edge[end] - edge[1 - end]).normalized();  // out of the tunnel
      AddWall(piece.structure->id, middle, middle + network::kPortalDeep_m * along, network::kPortalWing_m, height);
    }
  }
}

void ObstacleMap::AddWall(const std::string& name, const Vector3d& from_W, const Vector3d& to_W, double width_m,
                          double height_m) {
  const Vector3d way = to_W - from_W;
  const double length = way.head<2>().norm();
  if (length > 0.0)
    AddBox(name, 0.5 * (from_W + to_W), std::atan2(way.y(), way.x()), {length, width_m, height_m}, true);
}

void ObstacleMap::AddBox(const std::string& name, const Vector3d& foot_W, double heading_rad, const Vector3d& size_m,
                         bool stands) {
  const double low = stands ? -kBelow_m : 0.0, high = stands ? std::max(size_m.z(), kTall_m) : size_m.z();
  dynamics::Obstacle box;
  box.id = obstacles_.size();
  box.centre_W = foot_W + 0.5 * (low + high) * Vector3d::UnitZ();
  box.q_WO = Eigen::AngleAxisd(heading_rad, Vector3d::UnitZ());
  box.half_m = 0.5 * Vector3d(size_m.x(), size_m.y(), high - low);
  const double around = box.half_m.head<2>().norm() + reach_m_;
  const Cell first = CellAt(box.centre_W.x() - around, box.centre_W.y() - around),
             last = CellAt(box.centre_W.x() + around, box.centre_W.y() + around);
  for (std::int64_t i = first.first; i <= last.first; ++i) {
    for (std::int64_t j = first.second; j <= last.second; ++j)
      cells_[{i, j}].push_back(static_cast<std::uint32_t>(obstacles_.size()));
  }
  obstacles_.push_back(box);
  names_.push_back(name);
}

ObstacleMap::Cell ObstacleMap::CellAt(double x_m, double y_m) {
  return {static_cast<std::int64_t>(std::floor(x_m / kCell_m)), static_cast<std::int64_t>(std::floor(y_m / kCell_m))};
}

std::span<const std::uint32_t> ObstacleMap::Near(const Vector3d& p_W) const {
  const auto found = cells_.find(CellAt(p_W.x(), p_W.y()));
  return found == cells_.end() ? std::span<const std::uint32_t>() : std::span<const std::uint32_t>(found->second);
}

}  // namespace rodeira::nodes

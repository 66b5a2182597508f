// SPDX-License-Identifier: Apache-2.0
// Where people stand who watch from beside the road.
#include <algorithm>
#include <cmath>

#include "common/view/scene/camera/camera.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPostSpacing_m = 120.0;  // posts along a road
constexpr double kLattice_m = 80.0;       // posts where there is none
constexpr double kAside_m = 1.5;          // of the road's edge
constexpr double kMaxAside_m = 30.0;
constexpr double kFarOff_m = 60.0;        // from there on no road is near
constexpr double kEye_m = 1.9;            // over the ground: a person on a box
constexpr double kTracksideView_m = 7.0;  // of the world at the car, from the picture's lower to its upper edge
constexpr double kNarrowest_rad = 0.05, kWidest_rad = 1.1;

// The road's edge at s on one side, from its reference line, positive to the left.
double EdgeAt(const network::Road& road, double s_m, bool left) {
  const network::LaneSection& section = road.SectionAt(s_m);
  double edge_m = road.CentreAt(s_m).value;
  const auto& lanes = left ? section.left : section.right;
  if (!lanes.empty()) {
    if (const auto span = section.Span(lanes.back().id, road.CentreAt(s_m), s_m)) edge_m = span->outer_t_m;
  }
  return std::clamp(edge_m, -kMaxAside_m, kMaxAside_m);
}

Vector2d Post(const Body& car, const road::World& world) {
  const Vector3d& p = car.p_WB_W;
  const auto place = world.network() == nullptr ? std::nullopt : world.network()->Locate(p.x(), p.y(), p.z());
  if (!place || place->distance_m > kFarOff_m) {
    return {(std::floor(p.x() / kLattice_m) + 0.5) * kLattice_m, (std::floor(p.y() / kLattice_m) + 0.5) * kLattice_m};
  }
  const network::Road& road = world.network()->roads()[place->lane.road];
  const double number = std::floor(place->s_m / kPostSpacing_m);
  const double s_m = std::min((number + 0.5) * kPostSpacing_m, road.length_m());
  const bool left = std::fmod(number, 2.0) != 0.0;
  const double t_m = EdgeAt(road, s_m, left) + (left ? kAside_m : -kAside_m);
  return road.Surface(s_m, t_m).p_W.head<2>();
}

}  // namespace

Camera TracksideCamera(const Body& car, const road::World& world) {
  const Vector2d post = Post(car, world);
  const Vector3d target = car.p_WB_W + Vector3d(0.0, 0.0, 0.5 * car.height_m);
  const road::SurfacePoint ground = world.At(post.x(), post.y(), car.p_WB_W.z());
  const Vector3d eye(post.x(), post.y(), (ground.inside ? ground.z_m : car.p_WB_W.z()) + kEye_m);
  const Vector3d towards = target - eye;
  // A car that drives over the post is looked down upon from the box.
  const Vector3d forward = towards.norm() > 0.1 ? towards : Vector3d(car.q_WB * Vector3d::UnitX());
  const bool steep = std::hypot(forward.x(), forward.y()) < 1e-3 * forward.norm();
  return LookFrom(
      eye, forward, steep ? Vector3d::UnitY() : Vector3d::UnitZ(),
      std::clamp(2.0 * std::atan(0.5 * kTracksideView_m / std::max(towards.norm(), 0.1)), kNarrowest_rad, kWidest_rad));
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/camera/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/core/base/constants.hpp"
#include "common/view/scene/smooth_step.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kClearance_m = 0.9;  // of an eye outside of the car over the ground
constexpr auto kNames = std::to_array<std::string_view>({"chase", "driver", "bonnet", "orbit", "top", "trackside"});

// The car's nose in plan, a unit vector; east for a car that stands on it.
Vector2d NoseInPlan(const Body& car) {
  const Vector3d nose = car.q_WB * Vector3d::UnitX();
  const double length = std::hypot(nose.x(), nose.y());
  return length > 1e-3 ? Vector2d(nose.x() / length, nose.y() / length) : Vector2d::UnitX();
}

constexpr double kChase_m = 7.2, kChaseHigh_m = 2.45;
constexpr double kMinChase_m = 1.0;
// The driver's eye over B's origin, and below the roof of a low car; below that of a lorry or a bus.
constexpr double kEyeHigh_m = 1.20, kEyeLow_m = 0.6, kHeadroom_m = 0.21, kCabRoof_m = 1.2;
constexpr double kCabFront_m = 1.3;  // of a lorry's or bus's driver from its front

// How far behind the car its eye is, where so many others may stand between it and the car. In plan, along the car's
// nose.
double ChaseDistance(const Body& car, double eye_z_m, std::span<const Body> others) {
  constexpr double kBefore_m = 0.5;                    // of another's front
  constexpr double kClear_m = 1.4, kInTheWay_m = 0.3;  // from the line of sight to its side
  constexpr double kBelow_m = 0.3, kAbove_m = 0.1;     // of the line of sight: its roof
  const Vector2d nose = NoseInPlan(car), left(-nose.y(), nose.x());
  const double rear = car.length_m - car.front_m, roof_z_m = car.p_WB_W.z() + car.height_m;
  double distance = kChase_m;
  for (const Body& other : others) {
    const Vector2d to = (other.p_WB_W - car.p_WB_W).head<2>();
    if (to.squaredNorm() > 40.0 * 40.0) continue;
    double first = -1e9, last = 1e9, low = 1e9, high = -1e9;  // of its corners: along the nose, to the left
    for (const double x : {other.front_m, other.front_m - other.length_m}) {
      for (const double y : {0.5 * other.width_m, -0.5 * other.width_m}) {
        const Vector2d corner = to + (other.q_WB * Vector3d(x, y, 0.0)).head<2>();
        first = std::max(first, corner.dot(nose));
        last = std::min(last, corner.dot(nose));
        low = std::min(low, corner.dot(left));
        high = std::max(high, corner.dot(left));
      }
    }
    if (last > -rear) continue;  // beside or before it
    const double front = std::min(first, -rear), aside = std::max({low, -high, 0.0});
    const double sight_z_m = roof_z_m + (eye_z_m - roof_z_m) * std::min(-front / kChase_m, 1.0);
    const double wheels_m = other.p_WB_W.z() - sight_z_m;  // over the line of sight: on a bridge
    const double weight = (1.0 - SmoothStep(aside, kInTheWay_m, kClear_m)) *
                          SmoothStep(wheels_m + other.height_m, -kBelow_m, kAbove_m) *
                          (1.0 - SmoothStep(wheels_m, 0.0, 1.0));
    const double wanted = std::clamp(-front - kBefore_m, kMinChase_m, kChase_m);
    distance = std::min(distance, kChase_m - weight * (kChase_m - wanted));
  }
  return distance;
}

Vector3d AboveGround(Vector3d eye_W, const road::World& world) {
  const road::SurfacePoint below = world.At(eye_W.x(), eye_W.y(), eye_W.z());
  if (below.inside) eye_W.z() = std::max(eye_W.z(), below.z_m + kClearance_m);
  return eye_W;
}

}  // namespace

Camera LookFrom(const Vector3d& eye_W, const Vector3d& forward, const Vector3d& up, double vertical_view_rad) {
  Camera camera;
  camera.eye_W = eye_W;
  camera.forward_W = forward.normalized();
  const Vector3d right = camera.forward_W.cross(up).normalized();
  camera.up_W = right.cross(camera.forward_W);
  camera.vertical_view_rad = vertical_view_rad;
  return camera;
}

std::span<const std::string_view> CameraNames() { return kNames; }

std::optional<CameraKind> CameraOf(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  return found == kNames.end() ? std::nullopt : std::optional(static_cast<CameraKind>(found - kNames.begin()));
}

CameraKind NextCamera(CameraKind kind) {
  return static_cast<CameraKind>((static_cast<std::size_t>(kind) + 1) % kNames.size());
}

std::optional<Vector2d> Camera::Project(const Vector3d& p_W, int width_px, int height_px) const {
  const Vector3d d = p_W - eye_W;
  const double depth = d.dot(forward_W);
  if (depth <= 1e-6) return std::nullopt;
  const Vector3d right = forward_W.cross(up_W);
  if (window) {
    return Vector2d(width_px * (d.dot(right) / depth - window->left) / (window->right - window->left),
                    height_px * (window->high - d.dot(up_W) / depth) / (window->high - window->low));
  }
  const double scale = parallel_height_m > 0.0
                           ? height_px / parallel_height_m
                           : 0.5 * height_px / (std::tan(0.5 * vertical_view_rad) * depth);  // pixels a metre
  return Vector2d(0.5 * width_px + scale * d.dot(right), 0.5 * height_px - scale * d.dot(up_W));
}

Body::Body(const CarPose& car)
    : p_WB_W(car.p_WB_W),
      q_WB(car.q_WB),
      length_m(car.length_m),
      front_m(car.front_m),
      width_m(car.width_m),
      height_m(car.height_m) {}

Body::Body(const AgentPose& agent)
    : p_WB_W(agent.p_WB_W),
      q_WB(agent.q_WB),
      length_m(agent.length_m),
      front_m(0.5 * agent.length_m),
      width_m(agent.width_m),
      height_m(agent.height_m) {}

std::optional<Body> BodyAt(const SceneSnapshot& moment, std::size_t number) {
  if (number < moment.cars.size()) return Body(moment.cars[number]);
  number -= moment.cars.size();
  return number < moment.agents.size() ? std::optional(Body(moment.agents[number])) : std::nullopt;
}

void Aim::Turn(double by_azimuth_rad, double by_elevation_rad) {
  azimuth_rad = std::remainder(azimuth_rad + by_azimuth_rad, 2.0 * base::kPi);
  elevation_rad =
      std::clamp(elevation_rad + by_elevation_rad, -5.0 * base::kRadiansPerDegree, 85.0 * base::kRadiansPerDegree);
}

void Aim::Zoom(double factor) {
  distance_m = std::clamp(distance_m * factor, 2.5, 400.0);
  map_height_m = std::clamp(map_height_m * factor, 8.0, 5000.0);
}

Camera ChaseCamera(const Body& car, const road::World& world, std::span<const Body> others) {
  const Vector3d nose = car.q_WB * Vector3d::UnitX();
  const Vector3d ahead = std::hypot(nose.x(), nose.y()) > 1e-3
                             ? Vector3d(nose.x(), nose.y(), 0.7 * nose.z()).normalized()
                             : Vector3d::UnitX();
  const double away_m = ChaseDistance(car, car.p_WB_W.z() - kChase_m * ahead.z() + kChaseHigh_m, others);
  const Vector3d eye = AboveGround(car.p_WB_W - away_m * ahead + Vector3d(0.0, 0.0, kChaseHigh_m), world);
  const double share =
      (away_m - kMinChase_m) /
      (kChase_m - kMinChase_m);  // the nearer the eye, the steeper it looks: the car stays in the picture
  const Vector3d target = car.p_WB_W + 9.0 * share * ahead + Vector3d(0.0, 0.0, 0.75);
  return LookFrom(eye, target - eye, Vector3d::UnitZ(), 48.0 * base::kRadiansPerDegree);
}

Vector3d DriversEye_B(const Body& car) {
  const double low = std::max(kEyeLow_m, std::min(kEyeHigh_m, car.height_m - kHeadroom_m)),
               cab = car.height_m - kCabRoof_m;
  return {cab > low ? car.front_m - kCabFront_m : 0.10, 0.22 * car.width_m, std::max(low, cab)};
}

Camera DriverCamera(const Body& car) {
  const Vector3d forward_B(1.0, 0.0, -0.015);
  return LookFrom(car.p_WB_W + car.q_WB * DriversEye_B(car), car.q_WB * forward_B, car.q_WB * Vector3d::UnitZ(),
                  52.0 * base::kRadiansPerDegree);
}

Camera ScreenCamera(const Body& car, const ScreenPlane& screen) {
  const Vector3d forward_B(std::cos(screen.angle_rad), std::sin(screen.angle_rad), 0.0);
  Camera camera =
      LookFrom(car.p_WB_W + car.q_WB * DriversEye_B(car), car.q_WB * forward_B, car.q_WB * Vector3d::UnitZ(), 0.0);
  const double half_m = 0.5 * screen.width_m;
  camera.window = Camera::Window{
      (screen.aside_m - half_m) / screen.distance_m, (screen.aside_m + half_m) / screen.distance_m,
      -screen.eye_height_m / screen.distance_m, (screen.height_m - screen.eye_height_m) / screen.distance_m};
  camera.vertical_view_rad = std::atan(camera.window->high) - std::atan(camera.window->low);
  return camera;
}

Camera BonnetCamera(const Body& car) {
  const Vector3d eye_B(car.front_m - 0.30 * car.length_m, 0.0, 0.74 * car.height_m);  // before the windscreen
  const Vector3d forward_B(1.0, 0.0, -0.03);
  return LookFrom(car.p_WB_W + car.q_WB * eye_B, car.q_WB * forward_B, car.q_WB * Vector3d::UnitZ(),
                  52.0 * base::kRadiansPerDegree);
}

Camera OrbitCamera(const Body& car, const Aim& aim, const road::World& world) {
  const Vector2d nose = NoseInPlan(car), right(nose.y(), -nose.x());
  const Vector2d out = -std::cos(aim.azimuth_rad) * nose + std::sin(aim.azimuth_rad) * right;
  const Vector3d middle = car.p_WB_W + Vector3d(0.0, 0.0, 0.5 * car.height_m);
  const double level_m = aim.distance_m * std::cos(aim.elevation_rad);
  const Vector3d eye = AboveGround(
      middle + Vector3d(level_m * out.x(), level_m * out.y(), aim.distance_m * std::sin(aim.elevation_rad)), world);
  return LookFrom(eye, middle - eye, Vector3d::UnitZ(), 48.0 * base::kRadiansPerDegree);
}

Camera TopCamera(const Body& car, const Aim& aim) {
  // As high as the eye of a pinhole camera would be that shows as much: what is left out far away is the same.
  const double above_m = std::max(60.0, 1.2 * aim.map_height_m);
  Camera camera = LookFrom(car.p_WB_W + Vector3d(0.0, 0.0, above_m), -Vector3d::UnitZ(), Vector3d::UnitY(),
                           48.0 * base::kRadiansPerDegree);
  camera.parallel_height_m = aim.map_height_m;
  return camera;
}

Camera MakeCamera(CameraKind kind, const Body& car, const Aim& aim, const road::World& world,
                  std::span<const Body> others) {
  switch (kind) {
    case CameraKind::kChase:
      return ChaseCamera(car, world, others);
    case CameraKind::kDriver:
      return DriverCamera(car);
    case CameraKind::kBonnet:
      return BonnetCamera(car);
    case CameraKind::kOrbit:
      return OrbitCamera(car, aim, world);
    case CameraKind::kTop:
      return TopCamera(car, aim);
    case CameraKind::kTrackside:
      return TracksideCamera(car, world);
  }
  return ChaseCamera(car, world, others);
}

std::optional<Camera> MakeCamera(CameraKind kind, const SceneSnapshot& moment, std::size_t number, const Aim& aim,
                                 const road::World& world) {
  const auto body = BodyAt(moment, number);
  if (!body) return std::nullopt;
  std::vector<Body> others;
  for (std::size_t i = 0, all = moment.cars.size() + moment.agents.size(); i < all; ++i) {
    if (i != number) others.push_back(*BodyAt(moment, i));
  }
  return MakeCamera(kind, *body, aim, world, others);
}

}  // namespace rodeira::scene

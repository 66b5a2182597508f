#include "common/scene/camera.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry/angle.hpp"

namespace rodeira::scene {
namespace {

constexpr double kDegree = geometry::kPi / 180.0;
constexpr double kClearance_m = 0.9;  // of the chasing eye over the ground

Camera Look(const Eigen::Vector3d& eye_W, const Eigen::Vector3d& forward, const Eigen::Vector3d& up, double view_rad) {
  Camera camera;
  camera.eye_W = eye_W;
  camera.forward_W = forward.normalized();
  const Eigen::Vector3d right = camera.forward_W.cross(up).normalized();
  camera.up_W = right.cross(camera.forward_W);
  camera.vertical_view_rad = view_rad;
  return camera;
}

}  // namespace

std::optional<Eigen::Vector2d> Camera::Project(const Eigen::Vector3d& p_W, int width_px, int height_px) const {
  const Eigen::Vector3d d = p_W - eye_W;
  const double depth = d.dot(forward_W);
  if (depth <= 1e-6) return std::nullopt;
  const Eigen::Vector3d right = forward_W.cross(up_W);
  const double scale = 0.5 * height_px / std::tan(0.5 * vertical_view_rad);  // pixels a unit of slope
  return Eigen::Vector2d(0.5 * width_px + scale * d.dot(right) / depth, 0.5 * height_px - scale * d.dot(up_W) / depth);
}

Camera ChaseCamera(const CarPose& car, const road::World& world) {
  const Eigen::Vector3d nose = car.q_WB * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d ahead = std::hypot(nose.x(), nose.y()) > 1e-3 ? Eigen::Vector3d(nose.x(), nose.y(), 0.7 * nose.z()).normalized() : Eigen::Vector3d::UnitX();
  Eigen::Vector3d eye = car.p_WB_W - 7.2 * ahead + Eigen::Vector3d(0.0, 0.0, 2.45);
  const road::SurfacePoint below = world.At(eye.x(), eye.y());
  if (below.inside) eye.z() = std::max(eye.z(), below.z_m + kClearance_m);
  const Eigen::Vector3d target = car.p_WB_W + 9.0 * ahead + Eigen::Vector3d(0.0, 0.0, 0.75);
  return Look(eye, target - eye, Eigen::Vector3d::UnitZ(), 48.0 * kDegree);
}

Camera DriverCamera(const CarPose& car) {
  const Eigen::Vector3d eye_B(0.10, 0.22 * car.width_m, 1.20);
  const Eigen::Vector3d forward_B(1.0, 0.0, -0.015);
  return Look(car.p_WB_W + car.q_WB * eye_B, car.q_WB * forward_B, car.q_WB * Eigen::Vector3d::UnitZ(), 52.0 * kDegree);
}

Camera MakeCamera(CameraKind kind, const CarPose& car, const road::World& world) {
  return kind == CameraKind::kDriver ? DriverCamera(car) : ChaseCamera(car, world);
}

}  // namespace rodeira::scene

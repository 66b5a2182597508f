#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/road/world.hpp"
#include "common/scene/moment.hpp"

namespace rodeira::scene {

enum class CameraKind { kChase, kDriver };

// From where and whereto one looks: a pure function of the car's pose (and of the ground, which it stays above), so that
// the camera is always in the same moment as the car.
struct Camera {
  Eigen::Vector3d eye_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d forward_W = Eigen::Vector3d::UnitX();  // unit
  Eigen::Vector3d up_W = Eigen::Vector3d::UnitZ();       // unit, square to forward
  double vertical_view_rad = 0.8;

  // Pixels from the left and from the top of a picture of that size; nothing for points behind the eye.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& p_W, int width_px, int height_px) const;
};

// Behind and above the car, without its roll.
Camera ChaseCamera(const CarPose& car, const road::World& world);
// In the driver's seat, on the left.
Camera DriverCamera(const CarPose& car);
Camera MakeCamera(CameraKind kind, const CarPose& car, const road::World& world);

}  // namespace rodeira::scene

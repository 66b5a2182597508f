// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/view/scene/camera/camera.hpp"

namespace rodeira::scene {

// One eye of a headset. Frame S is the driver's seat: its origin where DriversEye_B is, its axes those of the car's
// body.
struct HeadsetEye {
  Eigen::Vector3d p_SE = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_SE = Eigen::Quaterniond::Identity();  // of an eye that looks along its x, with z up
  Camera::Window window;
};

// What the eye sees of the world from the driver's seat: it moves and turns with the car.
Camera EyeCamera(const Body& car, const HeadsetEye& eye);

}  // namespace rodeira::scene

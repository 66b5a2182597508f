// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/camera/headset_eye.hpp"

#include <cmath>

namespace rodeira::scene {

Camera EyeCamera(const Body& car, const HeadsetEye& eye) {
  const Eigen::Quaterniond q_WE = car.q_WB * eye.q_SE;
  const Eigen::Vector3d eye_W = car.p_WB_W + car.q_WB * (DriversEye_B(car) + eye.p_SE);
  Camera camera = LookFrom(eye_W, q_WE * Eigen::Vector3d::UnitX(), q_WE * Eigen::Vector3d::UnitZ(),
                           std::atan(eye.window.high) - std::atan(eye.window.low));
  camera.window = eye.window;
  return camera;
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/renderer/aim_camera.hpp"

#include <numbers>

namespace rodeira::nodes {
namespace {

osg::Vec3d ToOsg(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

void AimCamera(osg::Camera& eye, const scene::Camera& camera, double aspect, double far_m) {
  const osg::Vec3d at = ToOsg(camera.eye_W);
  eye.setViewMatrixAsLookAt(at, at + ToOsg(camera.forward_W), ToOsg(camera.up_W));
  const double half_m = 0.5 * camera.parallel_height_m;
  if (camera.window) {
    const auto& [left, right, low, high] = *camera.window;
    eye.setProjectionMatrixAsFrustum(kNear_m * left, kNear_m * right, kNear_m * low, kNear_m * high, kNear_m, far_m);
  } else if (half_m > 0.0) {
    eye.setProjectionMatrixAsOrtho(-half_m * aspect, half_m * aspect, -half_m, half_m, kNear_m, far_m);
  } else {
    eye.setProjectionMatrixAsPerspective(camera.vertical_view_rad * 180.0 / std::numbers::pi, aspect, kNear_m, far_m);
  }
}

}  // namespace rodeira::nodes

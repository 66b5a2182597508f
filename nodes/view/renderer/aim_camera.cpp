// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/renderer/aim_camera.hpp"

#include "common/core/base/constants.hpp"
#include "nodes/view/materials/to_osg.hpp"

namespace rodeira::nodes {

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
    eye.setProjectionMatrixAsPerspective(camera.vertical_view_rad * 180.0 / base::kPi, aspect, kNear_m, far_m);
  }
}

}  // namespace rodeira::nodes

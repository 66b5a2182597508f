// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/lighting/sun_view.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace rodeira::scene {
namespace {

constexpr double kDepth_m = 3'000.0;  // what stands farther off towards the sun throws no shadow here

}  // namespace

Eigen::Vector3d SunView::ToMap(const Eigen::Vector3d& p_W) const {
  const Eigen::Vector3d p = p_W - middle_W;
  return {0.5 + right_W.dot(p) / side_m, 0.5 + up_W.dot(p) / side_m, 0.5 + 0.5 * forward_W.dot(p) / depth_m};
}

SunView MakeSunView(const Eigen::Vector3d& to_sun_W, const Eigen::Vector3d& about_W, double side_m, int side_px) {
  SunView view;
  view.side_m = side_m;
  view.depth_m = kDepth_m;
  view.forward_W = -to_sun_W.normalized();
  const Eigen::Vector3d aside = std::fabs(view.forward_W.z()) > 0.999
                                    ? Eigen::Vector3d::UnitX()
                                    : Eigen::Vector3d(view.forward_W.cross(Eigen::Vector3d::UnitZ()));
  view.right_W = aside.normalized();
  view.up_W = view.right_W.cross(view.forward_W);
  const double pixel_m = side_m / side_px;
  const auto snapped = [pixel_m](double place_m) { return pixel_m * std::round(place_m / pixel_m); };
  view.middle_W = snapped(view.right_W.dot(about_W)) * view.right_W + snapped(view.up_W.dot(about_W)) * view.up_W +
                  view.forward_W.dot(about_W) * view.forward_W;
  return view;
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/camera/pick.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

// How far along the ray it enters the box; nothing where it passes or the box lies behind.
std::optional<double> Enters(const Body& body, const Ray& ray) {
  const Vector3d from = body.q_WB.conjugate() * (ray.from_W - body.p_WB_W), along = body.q_WB.conjugate() * ray.along_W;
  const Vector3d low(body.front_m - body.length_m, -0.5 * body.width_m, 0.0),
      high(body.front_m, 0.5 * body.width_m, body.height_m);
  double in = 0.0, out = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::fabs(along[axis]) < 1e-12) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) return std::nullopt;
      continue;
    }
    const double a = (low[axis] - from[axis]) / along[axis], b = (high[axis] - from[axis]) / along[axis];
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  return in <= out ? std::optional(in) : std::nullopt;
}

}  // namespace

Ray RayAt(const Camera& camera, const Eigen::Vector2d& place_px, int width_px, int height_px) {
  const Vector3d right = camera.forward_W.cross(camera.up_W);
  const double x = place_px.x() / width_px, y = 1.0 - place_px.y() / height_px;  // shares from the lower left corner
  const double aspect = static_cast<double>(width_px) / height_px;
  if (camera.parallel_height_m > 0.0 && !camera.window) {
    const Vector3d from =
        camera.eye_W + camera.parallel_height_m * ((x - 0.5) * aspect * right + (y - 0.5) * camera.up_W);
    return {from, camera.forward_W};
  }
  const double half = std::tan(0.5 * camera.vertical_view_rad);
  const Camera::Window window = camera.window.value_or(Camera::Window{-half * aspect, half * aspect, -half, half});
  const Vector3d along = camera.forward_W + (window.left + x * (window.right - window.left)) * right +
                         (window.low + y * (window.high - window.low)) * camera.up_W;
  return {camera.eye_W, along.normalized()};
}

std::optional<std::size_t> BodyOn(const SceneSnapshot& moment, const Ray& ray, std::optional<std::size_t> without) {
  std::optional<std::size_t> first;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t number = 0; const auto body = BodyAt(moment, number); ++number) {
    const auto at = Enters(*body, ray);
    if (!at || *at >= nearest || number == without) continue;
    nearest = *at;
    first = number;
  }
  return first;
}

}  // namespace rodeira::scene

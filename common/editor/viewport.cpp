// SPDX-License-Identifier: Apache-2.0
#include "common/editor/viewport.hpp"

#include <algorithm>

namespace rodeira::editor {
namespace {

constexpr double kFinest_m = 1e-4, kCoarsest_m = 5e3;  // a pixel
constexpr double kFarthest_m = 1e6;                    // as far as maps reach

}  // namespace

void Viewport::Go(const Eigen::Vector2d& by_W) {
  middle_W = (middle_W + by_W).cwiseMax(-kFarthest_m).cwiseMin(kFarthest_m);
}

void Viewport::Zoom(double times, const Eigen::Vector2d& px) {
  const Eigen::Vector2d held_W = ToWorld(px);
  metres_per_px = std::clamp(metres_per_px / times, kFinest_m, kCoarsest_m);
  Go(held_W - ToWorld(px));
}

void Viewport::ShowWidth(double width_m) { metres_per_px = std::clamp(width_m / width_px, kFinest_m, kCoarsest_m); }

void Viewport::Show(const Eigen::Vector2d& low_W, const Eigen::Vector2d& high_W) {
  constexpr double kRoom = 1.1, kLeast_m = 20.0;
  const Eigen::Vector2d size = (high_W - low_W).cwiseMax(kLeast_m) * kRoom;
  metres_per_px = std::clamp(std::max(size.x() / width_px, size.y() / height_px), kFinest_m, kCoarsest_m);
  middle_W.setZero();
  Go(0.5 * (low_W + high_W));
}

}  // namespace rodeira::editor

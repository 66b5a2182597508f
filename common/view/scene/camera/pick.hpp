// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "common/view/scene/camera/camera.hpp"

namespace rodeira::scene {

// A half line.
struct Ray {
  Eigen::Vector3d from_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_W = Eigen::Vector3d::UnitX();  // unit
};

// All that a camera shows at a place of its picture, in pixels from the left and from the top: Camera::Project
// backward.
Ray RayAt(const Camera& camera, const Eigen::Vector2d& place_px, int width_px, int height_px);

// The first car on the ray, by its box from bumper to bumper: one of the moment's cars or, numbered behind them, of its
// traffic. `without`: the one in which the eye is.
std::optional<std::size_t> BodyOn(const SceneSnapshot& moment, const Ray& ray,
                                  std::optional<std::size_t> without = std::nullopt);

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace rodeira::editor {

// What of the plane a canvas shows: north is up. Pixels are counted from the canvas' upper left corner.
struct Viewport {
  Eigen::Vector2d middle_W = Eigen::Vector2d::Zero();
  double metres_per_px = 0.1;
  double width_px = 1.0, height_px = 1.0;

  // The length of what is visible, from edge to edge.
  double width_m() const { return width_px * metres_per_px; }
  // The point of W at a pixel of the canvas, and the pixel at a point of W; either may lie outside of the canvas.
  Eigen::Vector2d ToWorld(const Eigen::Vector2d& px) const {
    return middle_W + metres_per_px * Eigen::Vector2d(px.x() - 0.5 * width_px, 0.5 * height_px - px.y());
  }
  Eigen::Vector2d ToPixels(const Eigen::Vector2d& p_W) const {
    const Eigen::Vector2d from = (p_W - middle_W) / metres_per_px;
    return {0.5 * width_px + from.x(), 0.5 * height_px - from.y()};
  }
  // What is held in the hand at `px` goes along with it.
  void Drag(const Eigen::Vector2d& by_px) { Go({-by_px.x() * metres_per_px, by_px.y() * metres_per_px}); }
  // Moves the middle by so many metres, east and north.
  void Go(const Eigen::Vector2d& by_W);
  // So many times larger (above 0); the point below `px` stays where it is.
  void Zoom(double times, const Eigen::Vector2d& px);
  // So much of the plane from edge to edge, about the same middle.
  void ShowWidth(double width_m);
  // All of a rectangle, with some room around it.
  void Show(const Eigen::Vector2d& low_W, const Eigen::Vector2d& high_W);
};

}  // namespace rodeira::editor

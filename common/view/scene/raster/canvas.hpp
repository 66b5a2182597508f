// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"

namespace rodeira::scene {

using Polyline = std::vector<Eigen::Vector2d>;

// A picture of plain pixels: rows from below.
struct Raster {
  int width_px = 0;
  int height_px = 0;
  std::vector<Colour> pixels;

  // Column and row from the lower left corner. Precondition: within the picture.
  Colour At(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x)];
  }
};

// Paints shapes over one another, sixteen samples a pixel. The picture goes from (-half_width, -1) to (half_width, 1).
class Canvas {
 public:
  using Points = std::span<const Eigen::Vector2d>;

  Canvas(int width_px, int height_px, Colour ground);

  double half_width() const { return half_width_; }
  // Inside: where a ray crosses the outline an odd number of times.
  void Fill(Points outline, Colour colour);
  // Lengths are in the picture's coordinates.
  void Disc(const Eigen::Vector2d& middle, double radius, Colour colour);
  // A line with round ends and corners.
  void Stroke(Points points, double width, Colour colour);
  // The same with square ends.
  void Bar(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, Colour colour);
  // The mean of each pixel's samples.
  Raster Paint() const;

 private:
  static constexpr int kSamples = 4;  // a pixel, each way
  int width_, height_;                // in samples
  double half_width_;
  std::vector<Colour> samples_;
};

}  // namespace rodeira::scene

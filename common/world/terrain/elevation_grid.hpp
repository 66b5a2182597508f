// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace rodeira::terrain {

// The ground at a point as a height and its change: the upward normal is (-slope_x, -slope_y, 1), normalised.
struct GridSample {
  double z_m = 0.0;
  double slope_x = 0.0;  // dz/dx
  double slope_y = 0.0;  // dz/dy
  bool inside = false;   // false: outside of the grid, or a void

  Eigen::Vector3d normal_W() const { return Eigen::Vector3d(-slope_x, -slope_y, 1.0).normalized(); }
};

// Heights on posts: the outermost posts stand exactly on the edges, so the spacing is width / (columns - 1). Every cell
// is two triangles split along the diagonal from its south-east to its north-west corner (as VTP does); the ground is
// these triangles. All four edges belong to the grid. A triangle that touches a void post is no ground.
class ElevationGrid {
 public:
  static constexpr float kVoid = -32768.0F;

  // Number of posts, and the coordinates of the outermost ones in W.
  struct Frame {
    int columns = 0;  // >= 2, west to east
    int rows = 0;     // >= 2, south to north
    double west_m = 0.0, south_m = 0.0, east_m = 0.0, north_m = 0.0;
  };

  // heights_m[column * rows + row], columns from west to east, each from south to north, as in a .bt file.
  ElevationGrid(Frame frame, std::vector<float> heights_m, std::string projection_wkt = {});

  const Frame& frame() const { return frame_; }
  double spacing_x_m() const { return spacing_x_m_; }
  double spacing_y_m() const { return spacing_y_m_; }
  // The height of a post, m; kVoid where it has none. Precondition: a column and row of the frame.
  float Post(int column, int row) const {
    return heights_m_[static_cast<std::size_t>(column) * static_cast<std::size_t>(frame_.rows) +
                      static_cast<std::size_t>(row)];
  }
  std::span<const float> heights_m() const { return heights_m_; }
  const std::string& projection_wkt() const { return projection_wkt_; }

  // (x, y) in W. Not inside outside of the edges, beside a void post and for NaN.
  GridSample At(double x_m, double y_m) const;

 private:
  Frame frame_;
  double spacing_x_m_, spacing_y_m_;
  double cells_per_m_x_, cells_per_m_y_;
  std::vector<float> heights_m_;
  std::string projection_wkt_;
  bool has_voids_ = false;
};

}  // namespace rodeira::terrain

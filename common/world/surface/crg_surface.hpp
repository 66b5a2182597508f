// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/world/surface/crg_header.hpp"
#include "common/world/surface/crg_reference_line.hpp"

namespace rodeira::surface {

// The height at a place of the grid, and its change.
struct CrgPoint {
  double z_m = 0.0;
  double dz_du = 0.0;
  double dz_dv = 0.0;
  bool inside = false;  // false: beyond a border without continuation, or a missing height
};

// The same seen from the world.
struct CrgGround {
  double z_m = 0.0;
  double slope_x = 0.0;  // dz/dx
  double slope_y = 0.0;  // dz/dy
  double u_m = 0.0;
  double v_m = 0.0;
  bool inside = false;
};

// What a CrgSurface is made of.
struct CrgShape {
  CrgReferenceLine line;
  std::vector<double> v_m;       // ascending, two or more
  std::vector<double> heights;   // heights[row * v_m.size() + i] above the reference line and its banking; NaN: missing
  std::vector<double> line_z_m;  // the reference line's height a row
  std::vector<double> banking;   // dz/dv a row
  CrgOptions options;
};

// A curved regular grid (ASAM OpenCRG): z(u, v) is the bilinear interpolation of the heights, plus the reference line's
// height, plus the banking times v. Borders and smoothing zones as the file's options say. A grid line belongs to both
// cells beside it: a missing height takes away only what lies nearer to it. Immutable; every answer is a pure function
// of the grid.
class CrgSurface {
 public:
  explicit CrgSurface(CrgShape shape);

  // At (u, v). Not inside where a number is not finite.
  CrgPoint At(double u_m, double v_m) const;
  // At (x, y) of the file's plane: its foot on the reference line, and the slopes by x and y.
  CrgGround Ground(double x_m, double y_m) const;

  const CrgShape& shape() const { return shape_; }
  const CrgReferenceLine& line() const { return shape_.line; }
  std::size_t rows() const { return shape_.line_z_m.size(); }
  double length_m() const { return shape_.line.end_u_m() - shape_.line.begin_u_m(); }
  // Whether the option to close the track finds ends that meet: within 60 degrees, each before the other.
  bool closed() const { return closed_; }

 private:
  struct Cell {
    std::size_t index = 0;
    double share = 0.0;  // 0 to 1 within the cell
    double size_m = 0.0;
    double sign = 1.0;     // -1 where the grid is reflected
    bool outside = false;  // held at the border
  };
  Cell AlongU(double u_m) const;
  Cell AcrossV(double v_m) const;
  void FindClosure();
  double Fold(double value, double low, double high, CrgBorder border, double& sign) const;
  void Smooth(double from_m, double zone_m, double sign, double base_z_m, CrgPoint& point) const;

  CrgShape shape_;
  double v_step_m_ = 0.0;  // where the sections are evenly spaced
  bool closed_ = false;
  double close_low_u_m_ = 0.0, close_high_u_m_ = 0.0;  // where one end's prolongation passes into the other's
};

}  // namespace rodeira::surface

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "common/core/geometry/cubic.hpp"

namespace rodeira::network {

// Height of a cross-section over the plane that the superelevation turns, with its derivatives.
struct LateralPoint {
  double z_m = 0.0;
  double slope_s = 0.0;
  double slope_t = 0.0;
};

// One cross-section of the road at s: height over t.
struct Shape {
  double s_m = 0.0;
  geometry::CubicTable height;  // over t; to the right of the first record its first value
};

// A strip of a cross-section surface (OpenDRIVE 1.8). Its height is the sum of c[n](s) u^n, u counted outward from its
// inner edge; without a width it has no outer edge.
struct SurfaceStrip {
  bool relative = false;  // on top of the outer edge of the strip inside of it
  bool has_width = false;
  geometry::CubicTable width;
  std::array<geometry::CubicTable, 4> coefficients;
};

// Strips beside one another over the whole road (OpenDRIVE 1.8, crossSectionSurface).
struct CrossSectionSurface {
  geometry::CubicTable t_offset;   // where the inner edges of the first strips lie
  std::vector<SurfaceStrip> left;  // from inside outward
  std::vector<SurfaceStrip> right;
};

// Everything that a lateral profile says but superelevation. Empty: flat.
struct LateralProfile {
  geometry::CubicTable crossfall_left;  // angle over s, falling outward is positive
  geometry::CubicTable crossfall_right;
  std::vector<Shape> shapes;  // ascending; in between linear
  CrossSectionSurface surface;

  bool flat() const;
  // The sum of shapes, strips and crossfall at (s, t), t positive to the left.
  LateralPoint At(double s_m, double t_m) const;
};

}  // namespace rodeira::network

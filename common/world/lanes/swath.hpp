// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::lanes {

// The longest and widest car that conflict zones are made for.
struct LargestCar {
  double length_m = 5.2;
  double width_m = 1.92;
  double wheelbase_m = 3.2;
};

// How far to either side of a path of this curvature the rectangle of such a car reaches when its axles' middles lie on
// the path and halfway along it: for R = 1/|curvature|, r = sqrt(R² - (wheelbase/2)²), the larger of R - (r -
// width/2) on the inside and sqrt((r + width/2)² + (length/2)²) - R on the outside. Radii below 3 m count as 3 m.
double HalfSwath_m(double curvature_1pm, const LargestCar& car = {});

}  // namespace rodeira::lanes

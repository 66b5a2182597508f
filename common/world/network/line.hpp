// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/core/geometry/cubic.hpp"

namespace rodeira::network {

// A painted line of a road, apart from its lanes' marks: t(s) of its middle, between two stations.
struct PaintedLine {
  double from_s_m = 0.0;
  double to_s_m = 0.0;
  geometry::CubicTable t;  // of the line's middle over s
  double width_m = 0.1;
  double stroke_m = 0.0;         // of a dash, measured along the line's own length, which begins at from_s_m
  double gap_m = 0.0;            // behind it; 0: continuous
  std::string colour = "white";  // the names of RoadMark::colour
};

}  // namespace rodeira::network

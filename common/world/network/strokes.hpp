// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/world/network/road.hpp"

namespace rodeira::network {

// One painted piece of a line, in stations of the road.
struct Stroke {
  double from_s_m = 0.0;
  double to_s_m = 0.0;
};

// The painted pieces of one of the road's lines, in ascending s, to 1e-9 m. A dash is stroke_m long on the line itself,
// as seen from above, also where it runs on the inner or outer side of a bend or moves across the road. A continuous
// line is one piece. Nothing beyond the road's end.
std::vector<Stroke> Strokes(const Road& road, const PaintedLine& line);

}  // namespace rodeira::network

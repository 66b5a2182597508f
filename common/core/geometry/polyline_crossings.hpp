// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "common/core/geometry/polyline.hpp"

namespace rodeira::geometry {

// Two places of a line that are one in plan.
struct Crossing {
  double first_m = 0.0;  // by the given stations, first < second
  double second_m = 0.0;
};

// Where segments that are no neighbours cross or touch, by ascending stations. `stations` are told for the points:
// those of the line itself, or of another one that has as many. By a sweep along its longer extent: about as long as
// sorting, unless many segments lie side by side.
std::vector<Crossing> CrossingsOf(const Polyline& line, std::span<const double> stations);

}  // namespace rodeira::geometry

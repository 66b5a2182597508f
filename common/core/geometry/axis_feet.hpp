// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "common/core/geometry/plan_axis.hpp"

namespace rodeira::geometry {

// Points and their feet on one panel, number by number, so that each step of a formula is made for all of them at once.
struct AxisFeet {
  static constexpr std::size_t kMost = 200;
  using Numbers = std::array<double, kMost>;

  std::size_t count = 0;
  Numbers x_m, y_m;                                       // the points
  Numbers u_m, t_m, tangent_x, tangent_y, curvature_1pm;  // as AxisFoot says them
};

// Finds the feet, to the bit what PlanAxis::Foot says of each point. False, and then nothing is known, where one of
// them may lie at an end of the panel, or not be finite.
bool FindFeet(const PlanAxis& axis, const AxisPanel& panel, AxisFeet& feet);

}  // namespace rodeira::geometry

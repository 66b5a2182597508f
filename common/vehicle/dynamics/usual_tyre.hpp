// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/vehicle/dynamics/aligning_moment.hpp"
#include "common/vehicle/dynamics/magic_formula.hpp"

namespace rodeira::dynamics {

// A property of a tyre that can be computed with and that no tyre of a road vehicle has.
struct UnusualTyreValue {
  std::string_view key;        // the coefficient that it goes by, or that makes most of it
  std::string sentence;        // what it is, and what is usual or was expected
  bool is_impossible = false;  // no tyre at all is like that: nothing can be driven on it
};

// Load, pressure, radius, stiffness, friction and trail at FNOMIN; where these are usual, also the largest force over
// load at whatever slip. `aligning` may be null.
std::vector<UnusualTyreValue> UnusualTyreValues(const MagicFormulaSettings& tyre, const AligningSettings* aligning);

}  // namespace rodeira::dynamics

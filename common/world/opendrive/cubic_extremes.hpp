// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/geometry/cubic.hpp"

namespace rodeira::opendrive {

// A value and the argument at which it is taken.
struct Extreme {
  double value = 0.0, at = 0.0;
};

// The smallest value in [from, to] and where it is; from <= to. Exact but for rounding.
Extreme LeastOf(const geometry::Cubic& cubic, double from, double to);
// The value in [from, to] that is farthest from 0.
Extreme FarthestOf(const geometry::Cubic& cubic, double from, double to);

}  // namespace rodeira::opendrive

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/constants.hpp"

namespace rodeira::geometry {

using base::kPi;

// The same direction in (-pi, pi]; exact for angles that lie there already.
double WrapAngle(double angle_rad);

}  // namespace rodeira::geometry

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace rodeira::traffic {

// Behind a kink of linked lanes a path comes to the middle by a quintic (FrameOn): its largest offset, by the slope and
// the way, and its largest curvature, by the slope over the way.
inline constexpr double kQuinticOffset = 0.194, kQuinticBend = 3.93;

// Onto a lane that meets the one before with a kink, the tangent of which is `slope`: the way (m) over which a vehicle
// comes to the middle, so that it stays within 0.35 m of it, at least 3 m. Nothing where there is no kink.
inline std::optional<double> KinkWay_m(double slope) {
  constexpr double kKink = 0.1, kSwing_m = 0.35, kShortest_m = 3.0;
  if (std::fabs(slope) < kKink) return std::nullopt;
  return std::max(kShortest_m, kSwing_m / (kQuinticOffset * std::fabs(slope)));
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace rodeira::scene {

// 0 up to `from`, 1 from `to` on, smooth between; `from` may be the larger one.
inline double SmoothStep(double x, double from, double to) {
  const double share = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return share * share * (3.0 - 2.0 * share);
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/leader.hpp"

#include <cmath>

namespace rodeira::driver {

std::optional<Leader> FindLeader(const Way& path, std::span<const Footprint> others, double own_middle_m,
                                 double own_front_m, double half_width_m, double range_m) {
  std::optional<Leader> nearest;
  const Eigen::Vector3d here = path.At(own_middle_m).p_W;
  for (const Footprint& other : others) {
    // The distance as the crow flies is never more than that along the lane.
    if (std::hypot(other.x_m - here.x(), other.y_m - here.y()) > range_m + own_front_m - own_middle_m + other.length_m)
      continue;
    const auto span = path.SpanOf(other);
    if (!span || 0.5 * (span->rear_m + span->front_m) <= own_middle_m) continue;
    if (span->right_m > half_width_m || span->left_m < -half_width_m) continue;
    const double gap = span->rear_m - own_front_m;
    if (gap <= range_m && (!nearest || gap < nearest->gap_m)) nearest = Leader{gap, span->speed_mps};
  }
  return nearest;
}

}  // namespace rodeira::driver

// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/leader.hpp"

#include <cmath>

namespace rodeira::driver {
namespace {

constexpr double kRounding_m = 1e-6;

}  // namespace

std::optional<Leader> FindLeader(const Way& path, std::span<const Footprint> others, double own_middle_m,
                                 double own_front_m, double half_width_m, double range_m, LeaderHints& hints) {
  std::optional<Leader> nearest;
  const Eigen::Vector3d here = path.MiddleAt(own_middle_m);
  hints.resize(others.size());
  for (std::size_t i = 0; i < others.size(); ++i) {
    const Footprint& other = others[i];
    // The distance as the crow flies is never more than that along the lane.
    if (std::hypot(other.x_m - here.x(), other.y_m - here.y()) > range_m + own_front_m - own_middle_m + other.length_m)
      continue;
    // Those behind and those beyond the nearest so far need not be placed exactly.
    const double to_m = own_front_m + (nearest ? nearest->gap_m : range_m) + 0.5 * (other.length_m + other.width_m);
    const auto span = path.SpanNear(hints[i], other, {own_middle_m - kRounding_m, to_m + kRounding_m});
    if (!span || 0.5 * (span->rear_m + span->front_m) <= own_middle_m) continue;
    if (span->right_m > half_width_m || span->left_m < -half_width_m) continue;
    const double gap = span->rear_m - own_front_m;
    if (gap <= range_m && (!nearest || gap < nearest->gap_m)) nearest = Leader{gap, span->speed_mps};
  }
  return nearest;
}

}  // namespace rodeira::driver

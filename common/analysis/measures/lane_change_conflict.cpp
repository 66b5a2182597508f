// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/lane_change_conflict.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/conflict.hpp"

namespace rodeira::measures {

std::vector<LaneChangeConflict> ConflictsOf(const Drive& drive, std::size_t from, std::span<const LaneChange> changes,
                                            const LagLimits& limits) {
  std::vector<LaneChangeConflict> conflicts;
  for (const LaneChange& change : changes) {
    LaneChangeConflict conflict;
    const std::size_t begin = from + change.begin;
    // A change that begins at its crossing has no sample in the lane that is left.
    if (change.begin < change.crossing)
      conflict.leader_ttc_s =
          TimeToCollision_s(drive.leader.gap_m[begin], drive.speed_mps[begin], drive.leader.speed_mps[begin]);
    for (std::size_t i = change.begin; i <= change.end && from + i < drive.size(); ++i) {
      const Neighbour& beside = change.direction > 0 ? drive.left_follower : drive.right_follower;
      const Neighbour& lag = i < change.crossing ? beside : drive.follower;
      const std::size_t k = from + i;
      const bool is_beside = lag.gap_m[k] <= 0.0;
      const double ttc_s = is_beside ? 0.0 : TimeToCollision_s(lag.gap_m[k], lag.speed_mps[k], drive.speed_mps[k]);
      conflict.lag_ttc_s = std::fmin(conflict.lag_ttc_s, ttc_s);
      if (is_beside || ttc_s < limits.For(lag.speed_mps[k] - drive.speed_mps[k])) conflict.lag_too_near = true;
    }
    conflicts.push_back(conflict);
  }
  return conflicts;
}

}  // namespace rodeira::measures

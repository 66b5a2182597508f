// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/gap.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {

UsedOptions UsedOf(const FollowedOptions& options) {
  return Used({{"max_gap_m", options.max_gap_m},
               {"max_time_gap_s", options.max_time_gap_s},
               {"near_gap_m", options.near_gap_m},
               {"min_speed_mps", options.min_speed_mps}});
}

std::vector<double> FollowedGap(Series gap_m, Series own_mps, const FollowedOptions& options) {
  std::vector<double> gap(gap_m.begin(), gap_m.end());
  for (std::size_t i = 0; i < gap.size(); ++i) {
    const double reach_m =
        std::isnan(own_mps[i]) ? options.max_gap_m : std::max(options.near_gap_m, options.max_time_gap_s * own_mps[i]);
    if (gap[i] > std::min(reach_m, options.max_gap_m)) gap[i] = kMissing;
  }
  return gap;
}

std::vector<double> TimeGap(Series gap_m, Series own_mps, const FollowedOptions& options) {
  std::vector<double> time(gap_m.size(), kMissing);
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (own_mps[i] < options.min_speed_mps) continue;
    const double gap_s = gap_m[i] / own_mps[i];
    if (gap_s <= options.max_time_gap_s) time[i] = gap_s;
  }
  return time;
}

std::vector<double> Headway(Series gap_m, Series leader_length_m) {
  std::vector<double> headway(gap_m.size());
  for (std::size_t i = 0; i < headway.size(); ++i) headway[i] = gap_m[i] + leader_length_m[i];
  return headway;
}

Measure LeaderShare(Series gap_m, const FollowedOptions& options) {
  if (gap_m.empty()) return NotFound("no sample", "1", 0, 0, UsedOf(options));
  const double share = static_cast<double>(CountValid(gap_m)) / static_cast<double>(gap_m.size());
  return Found(share, "1", gap_m.size(), gap_m.size(), UsedOf(options));
}

}  // namespace rodeira::measures

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/driving/driver/way.hpp"

namespace rodeira::driver {

// The next thing ahead in the way.
struct Leader {
  double gap_m = 0.0;      // from one's own front bumper; negative where they overlap
  double speed_mps = 0.0;  // along the lane, negative towards us
};

// Where the others were found last, by their place in the list: it saves work and changes no result.
using LeaderHints = std::vector<std::size_t>;

// The nearest of the others within `range_m` ahead with a rectangle that reaches into a corridor of ±half_width_m about
// the lane's middle. Ahead is what has its middle ahead of our own. Of equal ones the first.
std::optional<Leader> FindLeader(const Way& path, std::span<const Footprint> others, double own_middle_m,
                                 double own_front_m, double half_width_m, double range_m, LeaderHints& hints);

}  // namespace rodeira::driver

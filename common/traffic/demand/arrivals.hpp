// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/traffic/demand/demand_settings.hpp"

namespace rodeira::traffic {

// When vehicle number `index` of a flow arrives, ns since the beginning, after the one before it arrived (or the flow
// began: from_s); below 0 where no more come. A pure function of the seed, the flow's number and its arguments.
// Poisson: the expected number between two arrivals is exponentially distributed with mean 1; even: it is 1 (before the
// first one a half).
std::int64_t NextArrival_ns(const FlowSettings& flow, std::uint64_t seed, std::uint64_t flow_number,
                            std::uint64_t index, std::int64_t before_ns);

}  // namespace rodeira::traffic

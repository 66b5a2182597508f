// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// What one driver did at a conflict line: from the rear of one vehicle to the front of the next, s.
struct GapDecision {
  double accepted_s = 0.0;
  double largest_rejected_s = 0.0;  // 0: none was rejected
};
// Drivers with an accepted gap that is smaller than a rejected one: to be flagged; both estimates leave them out.
std::size_t InconsistentDrivers(std::span<const GapDecision> drivers);

// Raff's critical gap: the length at which as many gaps that are accepted are shorter as gaps that are rejected are
// longer; the middle of such lengths. Missing without an accepted and a rejected gap.
Measure RaffCriticalGap(std::span<const double> accepted_s, std::span<const double> rejected_s);

// Mean of a lognormal distribution of the drivers' critical gaps, by maximum likelihood of one being between the
// largest rejected and the accepted gap (Troutbeck 1992). Missing without a rejected gap.
Measure TroutbeckCriticalGap(std::span<const GapDecision> drivers);

}  // namespace rodeira::measures

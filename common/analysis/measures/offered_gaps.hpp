// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/analysis/measures/drive.hpp"
#include "common/analysis/measures/gap_acceptance.hpp"

namespace rodeira::measures {

// Which gaps at junctions count as offered.
struct GapOptions {
  double line_m = 5.0;  // the driver has arrived when the front is so near to the junction's begin
  double max_gap_s = 20.0;
  bool with_lags = true;
};

// What was offered at one junction: times without a vehicle in the common areas, between the rear of one and the front
// of the next. The lag is the time from the driver's arrival to the first front.
struct OfferedGaps {
  double time_s = 0.0;  // at which the driver goes into the first common area
  std::vector<double> rejected_s;
  std::optional<double> accepted_s;  // nothing: no vehicle came behind within the time of an encounter
};
// One for each junction that is driven through where others cross or join the path, by time. Vehicles that have left
// the common area when the driver arrives, and those that come later than the longest gap, offer nothing.
std::vector<OfferedGaps> FindOfferedGaps(const Drive& drive, const GapOptions& options);

// As the drivers' decisions: those with an accepted gap.
std::vector<GapDecision> DecisionsOf(std::span<const OfferedGaps> offered);

}  // namespace rodeira::measures

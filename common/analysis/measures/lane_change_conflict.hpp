// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "common/analysis/measures/drive.hpp"
#include "common/analysis/measures/lane_change.hpp"

// A lane change beside others: the leader in the lane that is left, and the lag, the follower in the lane that is
// entered.
namespace rodeira::measures {

// How near a lag may be, by its closing speed: the classes A, B and C of ISO 17387.
struct LagLimits {
  double ttc_10_s = 2.5;  // closing by 10 m/s at most
  double ttc_15_s = 3.0;  // by 15 m/s at most
  double ttc_20_s = 3.5;  // faster; the standard's last class ends at 20 m/s

  // The least time to collision, s, that is allowed at this closing speed.
  double For(double closing_mps) const {
    return closing_mps <= 10.0 ? ttc_10_s : closing_mps <= 15.0 ? ttc_15_s : ttc_20_s;
  }
};

// How near others came in a change.
struct LaneChangeConflict {
  double leader_ttc_s = kMissing;  // at the begin; missing: no leader that the vehicle closes in on
  double lag_ttc_s = kMissing;     // least from begin to end; 0: the lag is beside; missing: none that closes in
  bool lag_too_near = false;       // in some sample: below its limit, or beside
};
// Of each change. `from`: the drive's sample to which the indices of the changes count.
std::vector<LaneChangeConflict> ConflictsOf(const Drive& drive, std::size_t from, std::span<const LaneChange> changes,
                                            const LagLimits& limits);

}  // namespace rodeira::measures

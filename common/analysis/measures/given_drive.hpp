// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/analysis/measures/drive.hpp"
#include "common/core/base/result.hpp"

namespace rodeira::measures {

// Time series from elsewhere, as the table of another simulator.
struct GivenDrive {
  double rate_hz = 0.0;
  std::map<std::string, std::vector<double>> columns;                  // by names of DriveColumns; of one length
  double front_m = kMissing, length_m = kMissing, width_m = kMissing;  // of the footprint; missing: not known
};

// The drive. What is not given is missing, but for what follows: the times in one lane end where `lane` or `road`
// changes, without `lane` where the position in the lane jumps by more than half a lane's width; such a jump is a lane
// change; the distances from the lines follow from position, lane width, heading error and footprint. Wrong input where
// a column is unknown (with the nearest name), of another length or where the rate is not above 0.
base::Result<Drive> DriveOf(const GivenDrive& given);

}  // namespace rodeira::measures

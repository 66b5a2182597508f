// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/config.hpp"

namespace rodeira::design {

// Tells of the lists of a road (vertical, superelevation, speed_limits, and of its own section offsets, crossfalls and
// widths) with a last point behind its end by more than a metre: one zero too many in a station changes
// what lies before. The grade of `vertical` may be that of a point some way behind the end: 100 m are let pass there.
void WarnBehindEnd(const config::Map& road, double length_m, std::vector<std::string>& warnings);

}  // namespace rodeira::design

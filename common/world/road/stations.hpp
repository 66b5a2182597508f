// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/world/road/road.hpp"

namespace rodeira::road {

// Where to cut the road for a mesh: ascending s from 0 to its length, with every joint of the axis and of the grades
// among them. Between two neighbours no line along the road within its verges leaves its chord by more than
// chord_error_m, in plan or in height, and none is longer than longest_m.
std::vector<double> Stations(const Road& road, double chord_error_m, double longest_m = 50.0);

}  // namespace rodeira::road

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::road {

// t of places across a road's section at s that are looked at where roads lie about one another: the middle of each
// lane that is driven on, and 0.1 m within the outermost edges of all of them. Nothing where no lane is driven on.
std::vector<double> PlacesAcross(const network::Road& road, std::uint32_t section, double s_m);

// The stations of a road at which they are looked at: a metre apart at most, of roads over 1000 km a millionth of it;
// both ends are among them.
std::vector<double> StationsLookedAt(const network::Road& road);

}  // namespace rodeira::road

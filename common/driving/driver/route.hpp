// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::driver {

// A lane of a network as it is driven: from its beginning to its end, or against s.
struct RouteLeg {
  network::LaneKey lane;
  bool along = true;  // with growing s
};

// From a lane on, as its traffic goes, always into the drivable lane that turns least, until the route is length_m
// long, the lanes end, or it would come back onto itself on the same level.
std::vector<RouteLeg> StraightOn(const network::Network& network, const network::LaneKey& start, double length_m);

}  // namespace rodeira::driver

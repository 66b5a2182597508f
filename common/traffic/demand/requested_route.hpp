// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/traffic/demand/demand.hpp"

namespace rodeira::traffic {

// A route that a request gives to one vehicle, in place of its own until it leaves the road.
struct RequestedRoute {
  std::vector<std::string> ways;  // ROAD or ROAD:LANE, one after the other
  Route route;
};

}  // namespace rodeira::traffic

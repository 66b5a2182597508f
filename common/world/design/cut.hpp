// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/world/network/road.hpp"

namespace rodeira::design {

// The part of a road between two of its stations, as a road of its own: the same surface, lanes, paint and furniture
// there, counted from `from_m`. Lines are cut with the phase of their dashes kept; measured and made surfaces that go
// on beyond the part reach a metre over its ends.
network::Road Cut(const network::Road& road, double from_m, double to_m, std::string id);

}  // namespace rodeira::design

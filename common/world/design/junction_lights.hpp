// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "common/world/network/network.hpp"

namespace rodeira::design {

// A traffic light at a road's end for the traffic that comes to it, beside its outermost lane; into the road's own
// spec, with a stop line over the lanes. Its id; nothing where none comes.
std::optional<std::string> PutLight(network::RoadSpec& spec, network::End end);

}  // namespace rodeira::design

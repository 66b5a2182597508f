// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/world/lanes/graph.hpp"

namespace rodeira::traffic {

// Whether a track, with some way on from its end, is at least so long.
bool IsLongEnough(const lanes::Graph& graph, std::uint32_t track, double length_m);

}  // namespace rodeira::traffic

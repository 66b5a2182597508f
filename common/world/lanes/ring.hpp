// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/lanes/graph.hpp"

namespace rodeira::lanes {

// Whether a track belongs to the ring of a roundabout: going on along the inside it comes back to itself after one
// turn, to the left (left-hand traffic: right), within 250 m, never straight for more than a fifth of the way.
bool OnRing(const Graph& graph, std::uint32_t track);

}  // namespace rodeira::lanes

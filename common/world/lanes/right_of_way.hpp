// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/lanes/zones.hpp"

namespace rodeira::lanes {

// Who goes first in a zone, written into it. Where lights hold for both ways by the rules alone; otherwise in this
// order: signs (a STOP or give-way sign yields to none, none to a priority road's); the junction's own priorities; a
// roundabout's ring before who enters; on merging from nearly the same direction the lane that goes on before the one
// that ends, then the straighter; who comes from the right (left-hand traffic: left); of those who meet head-on who
// does not turn across the other's way; the first track.
void Decide(const Graph& graph, Zone& zone);

}  // namespace rodeira::lanes

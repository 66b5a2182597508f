// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/lanes/zones.hpp"

namespace rodeira::lanes {

// Which way has priority in a zone, written into it. Where lights hold for both ways by the rules alone; otherwise in
// this order: signs (a STOP or give-way sign yields to none, none to a priority road's); the junction's own priorities;
// a roundabout's ring before an entry; on merging from nearly the same direction the lane that goes on before the one
// that ends, then the straighter; the one from the right (left-hand traffic: left); of two that meet head-on the one
// that does not turn across the other's way; the first track.
void Decide(const Graph& graph, Zone& zone);

}  // namespace rodeira::lanes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/hash.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::road {

// Of every number of a network that can change an answer: axes, heights, lanes, materials, limits, paint, signs and
// objects, surfaces, junctions, in a fixed order; not of names and ids.
base::Digest HashOf(const network::Network& network);

}  // namespace rodeira::road

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/hash.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// Of what is seen of a network's world, as far as it is cheap to know: the content hash (SUELO, lanes, lines), lane
// marks, what stands there, models' files included. Ground that was drawn from a world with another digest is not this
// one's. world.network() must not be null.
base::Digest SeenDigest(const road::World& world);

}  // namespace rodeira::scene

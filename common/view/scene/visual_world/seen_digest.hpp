// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/hash.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// Digest of a network world's visible content, as far as it is cheap to compute: content hash (SUELO, lanes, lines),
// lane marks, static objects and the files of their models. A visual database with another digest does not belong to
// this world. Precondition: world.network() is not null.
base::Digest SeenDigest(const road::World& world);

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/hash.hpp"
#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// Of all that a road says of where it lies and how high, and of the ground beside it, between two stations: every
// number that can change a bit there, and of what lies beyond none but the whole record (plan element, cubic, bridge …)
// that reaches in. At its ends it says whether something goes on there. Where nothing of a road changes between the
// stations its digest stays, whatever the other roads do, their order included.
base::Digest StretchDigest(const road::World& world, std::uint32_t road, double from_s_m, double to_s_m);
// Of what matters on its lanes alone, in the same way: materials and their pictures, patches and bumps, measured
// surfaces. Not of its paint and of what stands at it.
base::Digest LookDigest(const road::World& world, std::uint32_t road, double from_s_m, double to_s_m,
                        PictureDigests& pictures);

}  // namespace rodeira::scene

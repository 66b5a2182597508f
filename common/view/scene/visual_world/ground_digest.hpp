// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "common/core/base/hash.hpp"
#include "common/view/scene/road_markings/mark_strips.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// Changes whenever the same world is drawn otherwise than before.
inline constexpr const char* kGroundVersion = "ground 22";

// Equal paint has equal digests: of pieces, and of a tile's.
base::Digest PaintDigest(std::span<const PaintPiece> paint);
base::Digest PaintDigest(const TilePaint& paint);
// Of what is the same for all of a world's land: what it is made of, where the terrain's posts stand (not how high),
// the picture that lies on it, and the drawing's own version.
base::Digest LandDigest(const road::World& world);

}  // namespace rodeira::scene

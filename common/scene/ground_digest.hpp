#pragma once

#include <span>

#include "common/base/hash.hpp"
#include "common/network/road.hpp"
#include "common/road/world.hpp"
#include "common/scene/mark_strips.hpp"
#include "common/scene/road_lines.hpp"

namespace rodeira::scene {

// Changes whenever the same world is drawn otherwise than before.
inline constexpr const char* kGroundVersion = "ground 19";

base::Digest PaintDigest(const TilePaint& paint);
// Of all of a road that is seen or that heights follow from: its lines, lanes, heights, materials, and its paint.
base::Digest RoadDigest(const network::Road& road, std::span<const Line3> lines, const TilePaint& paint);
// Of the terrain under the roads, and of all pictures that lie on it or on them.
base::Digest TerrainDigest(const road::World& world);

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/visual_world/ground_digest.hpp"

#include <fmt/format.h>

#include <array>

#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/view/scene/visual_world/ground_tile.hpp"

namespace rodeira::scene {
base::Digest PaintDigest(std::span<const PaintPiece> paint) {
  base::Digest digest = 0;
  for (const PaintPiece& piece : paint) {
    digest = base::Combine(digest, base::Hash(std::as_bytes(std::span(piece.p_W[0].data(), 12))));
    digest = base::Combine(digest, static_cast<base::Digest>(piece.colour.red) << 16 |
                                       static_cast<base::Digest>(piece.colour.green) << 8 | piece.colour.blue);
  }
  return digest;
}

base::Digest PaintDigest(const TilePaint& paint) {
  base::Digest digest = 0;
  for (const auto& [key, pieces] : paint) digest = base::Combine(digest, PaintDigest(pieces));
  return digest;
}

base::Digest LandDigest(const road::World& world) {
  base::Digest digest = base::Hash(
      fmt::format("{} {} {}", kGroundVersion, static_cast<int>(world.terrain_surface()), world.open_drive()));
  if (world.grid() != nullptr) {
    const auto& frame = world.grid()->frame();
    digest = base::Combine(digest, base::Hash(fmt::format("{} {} {} {} {} {}", frame.columns, frame.rows, frame.west_m,
                                                          frame.south_m, frame.east_m, frame.north_m)));
  }
  if (world.plane())
    digest = base::Combine(digest, base::Hash(fmt::format("{} {} {}", world.plane()->z_m, world.plane()->slope_x,
                                                          world.plane()->slope_y)));
  return world.ground_picture() == nullptr ? digest
                                           : base::Combine(digest, PictureDigests().Of(*world.ground_picture()));
}

base::Digest GroundPlan::SourceDigest(const TileKey& tile) const {
  const std::array<bool, 4> decks = land_.DecksAtEdges(tile);
  base::Digest digest = base::Combine(
      land_digest_, base::Hash(fmt::format("{} {} {} {} {} {} {}", tile.column, tile.row, land_.decks.contains(tile),
                                           decks[0], decks[1], decks[2], decks[3])));
  digest = base::Combine(digest, sources_.DigestOf(tile));
  if (const auto lines = segments_.find(tile); lines != segments_.end())
    digest = base::Combine(digest, base::Hash(std::as_bytes(std::span(lines->second))));
  for (const TilePaint& level : paint_) {
    const auto paint = level.find(tile);
    digest = base::Combine(digest, paint == level.end() ? 0 : PaintDigest(paint->second));
  }
  return base::Combine(digest, things_.DigestOf(tile));
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/tessellation/tile_weave.hpp"
#include "common/view/scene/tiles/tile_grid.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::scene {

// A piece of paint between two stations: corners counter-clockwise seen from above, on the road that it belongs to.
struct PaintPiece {
  std::array<Eigen::Vector3d, 4> p_W;
  Colour colour;
};

using TilePaint = std::map<TileKey, std::vector<PaintPiece>>;

// Puts a piece into every tile that it touches.
void AddPaint(const PaintPiece& piece, TilePaint& paint);

// A road's lines in pieces, for each tile those that touch it. The edges of a piece lie within chord_m of the line's.
void PaintRoad(const network::Road& road, double chord_m, TilePaint& paint);

// Of OpenDRIVE's words for colours; white for an unknown one.
Colour PaintColour(std::string_view name);

// The paint laid on a tile's ground, cut along its triangles: it lies in their planes exactly, whatever their size.
// Paint only lies on ground within a metre of the height of its own road.
Mesh LayPaint(std::span<const PaintPiece> pieces, const TileKey& tile, std::span<const GroundTriangle> ground);

}  // namespace rodeira::scene

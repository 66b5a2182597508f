// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "common/view/scene/tessellation/tile_plan.hpp"

// How a tile's triangles come to meet the ground: points put in round by round, until nothing is off.
namespace rodeira::scene {

// What is followed in a tile.
struct Followed {
  bool kept = false;    // beyond slopes the land is the terrain's own triangles
  bool slopes = false;  // cuts, fills and verges
  bool decks = false;   // what lies below bridges
};

// Puts points into a plan, with known faces, where its triangles are farther from SUELO's ground than the level
// allows.
void ConformToGround(const road::World& world, const Land& land, int level, const Followed& followed, TilePlan& plan);

// A line on a deck or at its edge, with points where what lies below bends.
std::vector<tessellation::GridPoint> LineOverGround(const road::World& world, const TileKey& key,
                                                    const tessellation::GridSegment& segment, int level);

// A triangle's middle, to whole steps.
tessellation::GridPoint MiddleOf(const tessellation::Triangulation& triangles,
                                 const tessellation::Triangulation::Triangle& triangle);

// New triangles belong to the face that they were cut from.
void PropagateFaces(TilePlan& plan);

// The squared distance, in steps.
inline double Squared(const tessellation::GridPoint& a, const tessellation::GridPoint& b) {
  const double dx = a.x - b.x, dy = a.y - b.y;
  return dx * dx + dy * dy;
}

}  // namespace rodeira::scene

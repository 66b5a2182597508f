// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/view/scene/mesh/repeated.hpp"
#include "common/view/scene/terrain/lattice.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// Where a tree stands and how it has grown.
struct Tree {
  Eigen::Vector3d foot_W = Eigen::Vector3d::Zero();
  double height_m = 5.0;
  double crown_m = 2.0;  // radius
  bool conifer = false;
  bool bush = false;  // leaves down to the ground
  Colour leaves;
};

// How a tree grows: what differs from one to the next of a kind is its place.
enum class TreeKind { kRound, kCone, kBush };
TreeKind KindOf(const Tree& tree);
// One of a kind, 1 m high and with a crown of 1 m radius: about 70 triangles at level 0, 30 at level 1, 16 from level 2
// on. It stands nowhere yet.
Repeated TreeModel(TreeKind kind, int level);
// Where TreeModel's tree of its kind is put, with its size and colour.
PlacedCopy PlaceOf(const Tree& tree);

}  // namespace rodeira::scene

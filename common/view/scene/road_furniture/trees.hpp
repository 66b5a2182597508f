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

// Trees on grass within sight of the roads, in patches: a pure function of the world and the seed. None stands on a
// road, its shoulders or verges.
std::vector<Tree> PlantTrees(const road::World& world, std::uint64_t seed);

// How a tree grows: what differs from one to the next of a kind is its place.
enum class TreeKind { kRound, kCone, kBush };
TreeKind KindOf(const Tree& tree);
// One of a kind, 1 m high and with a crown of 1 m radius: about 70 triangles at level 0, 30 at level 1, 16 from level 2
// on. It stands nowhere yet.
Repeated TreeModel(TreeKind kind, int level);
StandingPlace PlaceOf(const Tree& tree);

// The trees of each square of about 200 m that has any: one entry a kind, all with the same origin.
std::vector<std::vector<Repeated>> BuildTrees(const std::vector<Tree>& trees);

}  // namespace rodeira::scene

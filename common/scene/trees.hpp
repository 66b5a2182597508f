#pragma once

#include <vector>

#include "common/road/world.hpp"
#include "common/scene/lattice.hpp"
#include "common/scene/mesh.hpp"

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

// Trees on grass within sight of the roads, in patches: a pure function of the world and the seed. None stands on a road,
// its shoulders or verges.
std::vector<Tree> PlantTrees(const road::World& world, std::uint64_t seed);

// A tree's triangles: about 70 at level 0, 30 at level 1, 16 from level 2 on.
void AddTree(Mesh& mesh, const Tree& tree, int level = 0);

// The trees as meshes, one for each square of about 200 m that has any.
std::vector<Mesh> BuildTrees(const std::vector<Tree>& trees);

}  // namespace rodeira::scene

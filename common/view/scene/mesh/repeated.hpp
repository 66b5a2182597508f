// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/mesh/solids.hpp"

namespace rodeira::scene {

// One of the places at which a model stands.
struct PlacedCopy {
  Stand stand;
  double across = 1.0, up = 1.0;  // so many times as wide and as high as the model
  Colour leaves;                  // of what grows
};

// A model that stands at many places: what draws it has the model once, and a list of places.
struct Repeated {
  Mesh model;  // about its foot: its own origin is zero
  // Of a model with leaves, by vertex: how light a leaf is, a multiple of a quarter from 0 to 1; negative: the vertex
  // has its own colour. Empty: each has.
  std::vector<float> light;
  Eigen::Vector3d origin_W = Eigen::Vector3d::Zero();  // to which places are drawn relative
  std::vector<PlacedCopy> places;
};

// A leaf's colour: from the dark inside of a crown to its top.
Colour LeafColour(Colour leaves, double light);
// All that is repeated as plain triangles, a mesh a material. They must have the same origin.
std::vector<Mesh> Merged(std::span<const Repeated> all);

}  // namespace rodeira::scene

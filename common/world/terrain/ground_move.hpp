// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

namespace rodeira::terrain {

// A place in the map of an elevation file, and a heading in it, become those of the world.
using GroundMove = std::function<void(Eigen::Vector2d& p_W, double& heading_rad)>;

// The map that heights were brought from, where its scale is off, and where they lay in it, in its own units.
struct MapOrigin {
  std::string wkt;
  double west = 0.0, south = 0.0, east = 0.0, north = 0.0;
  double units_a_m = 1.0;  // metres of the map by a metre on the ground, in the middle
};

// How places move with heights that were brought from such a map: those that lie among the heights in that map. All
// others are taken for places of the world and stay. `projection_wkt`: the world's.
GroundMove MoveWith(const MapOrigin& origin, const std::string& projection_wkt);

}  // namespace rodeira::terrain

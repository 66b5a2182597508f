// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/terrain/lattice.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// How closely the meshes of roads follow them.
struct RoadTolerance {
  double chord_m = 0.01;   // in plan and in height, within the verges
  double longest_m = 4.0;  // distance of two lines across the road: beside it the ground bends too
};

// A line across a road, from the outer edge of the right blend to that of the left one.
struct CrossLine {
  double s_m = 0.0;
  double beyond_m = 0.0;  // past an end of the road: negative before the start
  Eigen::Vector2d axis_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d left_W = Eigen::Vector2d::UnitY();

  Eigen::Vector2d At(double t_m) const { return axis_W + t_m * left_W; }
};

// The ground that a road shapes, in plan: quadrilaterals between lines across it, past both ends as far as its blend.
// Within it the picture is the road's; without it the terrain's.
struct Ribbon {
  std::vector<CrossLine> lines;
  std::size_t first = 0;  // the lines at the road's start and end
  std::size_t last = 0;
  double right_t_m = 0.0;
  double left_t_m = 0.0;

  // Counter-clockwise, between lines[i] and lines[i + 1].
  std::array<Eigen::Vector2d, 4> Quad(std::size_t i) const;
};
Ribbon LayRibbon(const road::Road& road, const RoadTolerance& tolerance);

// A piece of a road as it is seen.
struct RoadTile {
  std::vector<Mesh>
      ground;  // carriageway, shoulders, verges, blend; one mesh a material, nothing above or below another
  Mesh marks;  // lies exactly on the ground at its vertices: to be drawn after it, with an offset
};

// Pieces of about tile_m along the road. Every vertex lies on SUELO. The outer edge meets the lattice's triangles
// without a gap: there are vertices wherever it passes from one of them to another.
std::vector<RoadTile> BuildRoad(const road::World& world, const road::Road& road, const Ribbon& ribbon,
                                const Lattice& lattice, double tile_m = 128.0);

}  // namespace rodeira::scene

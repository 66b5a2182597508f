// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/view/scene/ground_materials/along_lane.hpp"
#include "common/view/scene/mesh/mesh.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// How a piece of ground looks.
struct Skin {
  Material material = Material::kGround;
  Colour colour;
  ground::Surface surface = ground::Surface::kGrass;
  bool land = true;   // beside all roads
  bool grown = true;  // its colour changes from place to place
  std::optional<terrain::LaidPicture> picture;
  std::optional<AlongLane> along;  // the picture lies along a lane; none: by east and north
};

// How a surface is drawn where it has no picture.
Material MaterialOf(ground::Surface surface);

// Of one of SUELO's levels at a place: by what it is made of, and by the type of the lane there.
Skin SkinAt(const road::World& world, const Eigen::Vector2d& p_W, const road::SurfacePoint& level);

}  // namespace rodeira::scene

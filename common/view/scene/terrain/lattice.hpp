// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// The terrain without roads as posts in a lattice, in triangles split along the diagonal from south-east to north-west:
// for a world on an elevation grid its own posts and triangles, for a plane a large piece of it around the start.
class Lattice {
 public:
  // inside: false where the post has no height.
  struct Sample {
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal_W = Eigen::Vector3d::UnitZ();
    Colour colour;
    bool inside = false;
  };

  // The world must outlive it.
  explicit Lattice(const road::World& world);

  int columns() const { return columns_; }  // posts from west to east
  int rows() const { return rows_; }        // posts from south to north
  Eigen::Vector2d spacing_m() const { return spacing_m_; }
  Material material() const { return material_; }

  // Whether the post has a height. Precondition: column < columns(), row < rows().
  bool IsKnown(int column, int row) const;
  // A post: height, and normal and colour for smooth shading.
  Sample Post(int column, int row) const;

 private:
  double Height(int column, int row) const;

  const road::World& world_;
  int columns_ = 0, rows_ = 0;
  Eigen::Vector2d south_west_W_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d spacing_m_ = Eigen::Vector2d::Ones();
  Material material_ = Material::kGround;
};

}  // namespace rodeira::scene

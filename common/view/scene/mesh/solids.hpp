// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"

namespace rodeira::scene {

// A place with upright axes of its own: x forward, y to the left, z up.
struct Stand {
  Eigen::Vector3d foot_W = Eigen::Vector3d::Zero();
  Eigen::Vector2d x_W = Eigen::Vector2d::UnitX();

  // The heading counts from east to north.
  static Stand At(const Eigen::Vector3d& foot_W, double heading_rad);
  Eigen::Vector3d ToWorld(const Eigen::Vector3d& p) const { return foot_W + Turned(p); }
  // A direction of the stand's frame, in W.
  Eigen::Vector3d Turned(const Eigen::Vector3d& v) const {
    return {x_W.x() * v.x() - x_W.y() * v.y(), x_W.y() * v.x() + x_W.x() * v.y(), v.z()};
  }
};

// A model's mesh, in its own frame around its origin, put to its place in another one.
void AddPlaced(const Mesh& model, const Stand& stand, Mesh& mesh);
// A flat convex face, its corners counter-clockwise seen from outside.
void AddFlat(Mesh& mesh, std::span<const Eigen::Vector3d> corners, Colour colour);
// An upright pole with a flat top about (x, y) = (0, 0): from z = low to high, its radius from `foot_m` to `top_m`.
Mesh Pole(double low_m, double high_m, double foot_m, double top_m, int sides, Colour colour);
// A straight bar between two points with closed ends: round, with radii `wide`, or a rectangle that reaches `wide` to
// both sides along `across_W` (where it lies along that itself: along the level line across it) and `high` to both
// sides across these two.
struct BarEnd {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  double wide_m = 0.0, high_m = 0.0;
};
// `sides`: of a round bar. Nothing where both ends are one point.
void AddBar(Mesh& mesh, const BarEnd& from, const BarEnd& to, bool round, int sides, const Eigen::Vector2d& across_W,
            Colour colour);
// A polygon, counter-clockwise seen from above, as triangles of its corners; nothing where it crosses itself.
std::vector<std::array<std::size_t, 3>> Ears(std::span<const Eigen::Vector3d> corners);
// A block upright on z = low: all sides but the one below.
Mesh Block(const Eigen::Vector3d& low, const Eigen::Vector3d& high, Colour colour);
// A roof over a block's top with its ridge along x.
Mesh Gable(const Eigen::Vector3d& low, const Eigen::Vector3d& high, Colour slopes, Colour ends);
// Walls along an outline (counter-clockwise seen from above, with feet and tops), and, where it is closed, a roof over
// it. Outlines that cross themselves get no roof.
void AddOutline(Mesh& mesh, std::span<const Eigen::Vector3d> feet_W, std::span<const double> heights_m, bool closed,
                Colour walls, Colour roof);

}  // namespace rodeira::scene

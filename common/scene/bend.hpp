#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/road/world.hpp"

namespace rodeira::scene {

// How closely the ground is to be followed.
struct BendRange {
  double tolerance_m = 0.003;  // so far from straight the ground may be
  double margin_m = 0.1;       // to either end; a way of less than four of these is left as it is
};

// Where on the way from a to b, as a part of it, the ground (the highest level) bends, if it leaves the straight way between the heights at the
// ends by more than the tolerance: the place where the tangents of both ends meet. Of a smooth bend that is its middle; where two
// straight pieces meet, as at the end of a slope, it is their edge. A pure function of the world and the two places, in this order.
// straight_ends: the tangents of both ends are known to lie on the way; then a way of up to 10 m is asked in its middle alone.
std::optional<double> BendBetween(const road::World& world, const Eigen::Vector2d& a_W, double a_z_m, const Eigen::Vector2d& b_W, double b_z_m,
                                  const BendRange& range, bool straight_ends = false);

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "common/world/road/world.hpp"

namespace rodeira::scene {

// How closely the ground is to be followed.
struct BendRange {
  double tolerance_m = 0.003;  // so far from straight the ground may be
  double margin_m = 0.1;       // to either end; a way of less than four of these is left as it is
  double step_m =
      2.0;  // of a long way no piece without a question is longer: a strip of a cut may end within a few metres
  double short_m = 1.0;  // a shorter way is asked in its middle alone: where one straight piece meets another near an
                         // end it is up to twice as far off there
  double ends_m =
      0.0;  // so far from both ends it is asked, too: strips of cuts beside a road may be this narrow; 0: it is not
};

// The ground that is followed, or one of its levels.
using GroundAt = std::function<road::SurfacePoint(const Eigen::Vector2d& p_W)>;

// Where on the way from a to b, as a part of it, the ground bends, if it leaves the straight way between the heights at
// the ends by more than the tolerance: the place where the tangents of both ends meet. Of a smooth bend that is its
// middle; where two straight pieces meet, as at the end of a slope, it is their edge. A pure function of the ground and
// the two places, in this order. It is asked in the middle, at the quarters and at every step. straight_ends: the
// tangents of both ends are known to lie on the way; then its quarters are not asked.
std::optional<double> BendBetween(const GroundAt& ground, const Eigen::Vector2d& a_W, double a_z_m,
                                  const Eigen::Vector2d& b_W, double b_z_m, const BendRange& range,
                                  bool straight_ends = false);

}  // namespace rodeira::scene

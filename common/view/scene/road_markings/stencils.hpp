// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>
#include <vector>

// Shapes that are painted on roads, as convex polygons seen from above, corners counter-clockwise, in metres. x runs
// with the traffic that reads them, y to its left; the middle of the shape's length is x = 0.
namespace rodeira::scene {

using Polygon2 = std::vector<Eigen::Vector2d>;

// Stripes of a zebra crossing and the gaps between them, stop lines along the traffic (Vienna Convention, annex 2: gaps
// of one to two stripes, both together 1 to 1.4 m; stop lines of 0.2 to 0.6 m).
inline constexpr double kStripe_m = 0.5, kStripeGap_m = 0.5, kStopLine_m = 0.3;
// Lines where one gives way: strokes across the lane and the gaps between them, as long along the traffic (the same
// annex: 0.2 to 0.6 m).
inline constexpr double kGiveWayLine_m = 0.4, kGiveWayStroke_m = 0.5, kGiveWayGap_m = 0.3;
inline constexpr double kArrow_m = 5.0;

// Where an arrow points; more than one for a lane from which one may turn too.
struct ArrowWays {
  bool left = false, straight = false, right = false;

  bool any() const { return left || straight || right; }
  bool operator==(const ArrowWays&) const = default;
};
// By what OpenDRIVE and some of its tools call them: "arrowStraightLeft", "SgRMArrowRight". Nothing where the word is
// no arrow, or one that merges.
ArrowWays WaysOf(std::string_view word);

// Lies in a rectangle of length_m by width_m around the origin, and reaches its ends; its stem is 0.15 m wide.
std::vector<Polygon2> ArrowShape(const ArrowWays& ways, double length_m, double width_m);

// Lines across a lane from right to left (y from `right_m` to `left_m`): a bar where one stops; where one gives way
// strokes, as many whole ones as have room, evenly to both sides of its middle, at least one. None where there is no
// room.
std::vector<Polygon2> StopLineShape(double right_m, double left_m);
std::vector<Polygon2> GiveWayShape(double right_m, double left_m);

// The stripes of a crossing that fills a convex outline. Stripes run along x, whole ones, evenly to both sides of the
// middle of the outline's extent in y, cut off by it.
std::vector<Polygon2> ZebraShape(const Polygon2& outline);

// The convex hull of points, counter-clockwise.
Polygon2 HullOf(std::span<const Eigen::Vector2d> points);

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// A rectangle on the ground: the footprint of a vehicle.
struct Footprint {
  Eigen::Vector2d middle_W = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;  // from east, counter-clockwise
  double length_m = 0.0, width_m = 0.0;
};
bool Overlap(const Footprint& a, const Footprint& b);

// What a path sweeps: its samples, and where it moves by more than a tenth of its length between two, poses between
// them, which are linear.
class SweptArea {
 public:
  explicit SweptArea(std::span<const Footprint> path);
  bool Touches(const Footprint& footprint) const;

 private:
  std::vector<Footprint> poses_;
};

// The first and the last time at which a path touches an area, in samples of the path: 2.5 lies between 2 and 3.
struct Stay {
  double enters = 0.0, leaves = 0.0;
  std::size_t samples = 0;            // that touch it
  bool begins = false, ends = false;  // it enters behind the path's begin, and leaves before its end
};
// Nothing where the path never touches it.
std::optional<Stay> StayIn(std::span<const Footprint> path, const SweptArea& area);

// Post-encroachment time of one encounter: the common area is the intersection of what both footprints sweep. One
// vehicle leaves it at tA, the other enters it at tB: tB - tA, s. Negative where the second enters before the first has
// left. Between the samples poses are linear. Both paths have one time base, and the same length. n: samples of both
// within the common area. Missing where there is no common area, or where the first one is still in it at the end.
Measure PostEncroachmentTime(std::span<const Footprint> a, std::span<const Footprint> b, double rate_hz);

}  // namespace rodeira::measures

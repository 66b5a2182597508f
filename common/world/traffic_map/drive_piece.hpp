// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/traffic_map/lane_shape.hpp"

namespace rodeira::traffic_map {

// a + b d + c d² + d d³ of the distance d from where it begins, m.
using Cubic1 = std::array<double, 4>;

// A stretch of a lane as OpenDRIVE says it: everything a cubic of the distance from its beginning.
struct DrivePiece {
  double s_m = 0.0;
  double length_m = 0.0;
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();  // where it begins, and its heading there
  double heading_rad = 0.0;
  Cubic1 u{}, v{};  // along and to the left of that heading
  Cubic1 left{};    // the left border's offset from the middle
  Cubic1 width{};
  Cubic1 z{};
};

// How far pieces are from their lane at most, m.
struct DriveError {
  double middle_m = 0.0;
  double border_m = 0.0;
  double height_m = 0.0;

  // The largest of the three.
  double Most() const;
  // Each error becomes the larger of both.
  void Include(const DriveError& other);
};

// What a piece may be off: at any place, and in the length of its curve, which is its s.
struct FitBounds {
  double off_m = 0.005;
  double length_m = std::numeric_limits<double>::infinity();
};

// A stretch of the lane in pieces, each halved until all its errors, measured at ten places, are within the bounds;
// `error` is what remains. Wrong input where a piece of 5 cm is not near enough yet.
base::Result<std::vector<DrivePiece>> FitLane(const LaneShape& lane, double from_m, double to_m,
                                              const FitBounds& bounds, DriveError& error);

}  // namespace rodeira::traffic_map

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "common/world/lanes/graph.hpp"
#include "common/world/lanes/swath.hpp"

namespace rodeira::lanes {

// Where a crossing lies across a track.
struct FootPass {
  std::uint32_t track = 0;
  double in_m = 0.0,
         out_m = 0.0;               // along the track: a car with no part of it between them touches no pedestrian
  double from_m = 0.0, to_m = 0.0;  // along the walk: a pedestrian beside them is touched by no car on the track
  std::int64_t light =
      -1;  // controller of the light that the track's traffic waits at before the crossing; below 0: none
};

// A place where people on foot cross a road: OpenDRIVE's objects 'crosswalk' and signals 293, and world files'
// crossings. They walk straight from kerb to kerb, u = 0 … length_m, where no car comes.
struct FootCrossing {
  std::uint32_t road = 0;  // at which it is described
  double s_m = 0.0;
  std::string id;                                       // of the object or signal
  Eigen::Vector2d begin_W = Eigen::Vector2d::Zero();    // the kerb at u = 0, in the middle of the walkway
  Eigen::Vector2d across_W = Eigen::Vector2d::UnitX();  // of unit length
  double length_m = 0.0;
  double half_width_m = 0.0;             // where people walk, to either side of the middle
  double before_m = 0.0, after_m = 0.0;  // no car comes so far beyond the kerb at u = 0, and beyond the other one
  std::int64_t light = -1;               // controller of a light for people on foot; below 0: none
  std::vector<FootPass> passes;          // ascending by track
  std::vector<double> heights_m;         // of the ground, every kHeightStep_m from u = -before_m on

  static constexpr double kHeightStep_m = 0.5;
  double HeightAt(double u_m) const;  // held beyond the ends
  Eigen::Vector2d left_W() const { return {-across_W.y(), across_W.x()}; }
};

// Those that lead across any track of the graph, by road, then as they are written. One with a kerb within 6 m
// under cars on every side is none.
std::vector<FootCrossing> FindFootCrossings(const Graph& graph, const LargestCar& car);

}  // namespace rodeira::lanes

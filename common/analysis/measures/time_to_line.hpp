// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/analysis/measures/measure.hpp"

// Time to line crossing by its three definitions.
namespace rodeira::measures {

// A vehicle in its lane, which goes on as a circle (curvature 0: straight).
struct LaneApproach {
  double y_m = 0.0;          // of the reference point from the lane's middle, positive to the left
  double heading_rad = 0.0;  // heading error to the lane, counter-clockwise
  double speed_mps = 0.0;    // along the heading
  double yaw_radps = 0.0;
  double lane_width_m = 0.0;
  double lane_curvature_1pm = 0.0;  // positive to the left
  double front_m = 0.0;             // from the reference point to the front corners, along the heading
  double width_m = 0.0;             // of the vehicle
};

// Trigonometric: the vehicle goes on with its present speed and yaw rate; the first t >= 0 at which a front corner is
// on a line of the lane. 0 where a corner is beyond one. Missing where no corner reaches a line within the horizon.
double TrigonometricTlc_s(const LaneApproach& approach, double horizon_s = 20.0);

// TLC 1: d / d', TLC 2: d / (d' + d'' 1 s) (van Winsum, Brookhuis & de Waard 2000): d is the distance to the line that
// is approached, d' the speed towards it, d'' its derivative. Missing where the denominator is not above 0; 0 where d
// is not.
double FirstOrderTlc_s(double distance_m, double towards_mps);
// towards_mps2: d''.
double SecondOrderTlc_s(double distance_m, double towards_mps, double towards_mps2);

// The least value of each approach, that is, of each run of valid samples.
std::vector<double> ApproachMinima(Series tlc_s);

}  // namespace rodeira::measures

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/bicycle_settings.hpp"

namespace rodeira::traffic {

// The line that a rear axle keeps so that the path lies midway between both axles' tracks, beside the path, metres,
// positive to the left: in a bend the rear one runs L² κ / 4 inside of it, the front one as much outside. κ is the mean
// of the path under the car, from bumper to bumper, by how far the path turns there (positive to the left), so that a
// long car is led over from one bend into the next, not all at once.
double RearLine_m(double wheelbase_m, double length_m, double turns_rad);

// Where a car's rear axle is beside the line that it is to keep.
struct RearBeside {
  double turned_rad = 0.0;     // its way off the path's direction, positive to the left
  double aside_m = 0.0;        // its middle off the line, positive to the left
  double curvature_1pm = 0.0;  // of the path where the car is when hands and tyres have answered, positive to the left
  double speed_mps = 0.0;
};

// The way over which hands make good what the rear axle is off its line: 0.7 s, at least 3 m and a wheelbase.
double SteeredWay_m(double wheelbase_m, double speed_mps);
// The way over which a bend is steered for before it is there: 0.6 s, at least 2 m.
double AnsweredWay_m(double speed_mps);

// Where the steering wheel is after dt, radians, positive to the left: hands lead back to the line, critically damped
// over the steered way, at 12 rad/s at most.
double MovedWheel_rad(const dynamics::BicycleSettings& car, const RearBeside& rear, double now_rad, double dt_s);

}  // namespace rodeira::traffic

#pragma once

#include "common/vehicle/bicycle_settings.hpp"

namespace rodeira::traffic {

// Where a car's rear axle is beside the path that it is to keep, both axles' middles over it.
struct RearBeside {
  double turned_rad = 0.0;     // its way off the path's direction, positive to the left
  double aside_m = 0.0;        // its middle off the path, positive to the left
  double curvature_1pm = 0.0;  // of the path where the car is when hands and tyres have answered, positive to the left
  double speed_mps = 0.0;
};

// The way over which hands make good what the rear axle is off its path: 0.7 s, at least 3 m.
double SteeredWay_m(double speed_mps);
// The way over which a bend is steered for before it is there: 0.6 s, at least 2 m.
double AnsweredWay_m(double speed_mps);

// Where the steering wheel is after dt, radians, positive to the left: hands lead back to the path, critically damped over the steered way, at 12 rad/s at most.
double MovedWheel_rad(const vehicle::BicycleSettings& car, const RearBeside& rear, double now_rad, double dt_s);

}  // namespace rodeira::traffic

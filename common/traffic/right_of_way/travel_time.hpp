// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::traffic {

// Seconds from speed_mps over a distance, gaining start_mps2 up to most_mps (at least 0.5 m/s); 0 where the distance is
// not positive. By these times agents tell in advance when they and others come and go.
double TravelTime(double distance_m, double speed_mps, double most_mps, double start_mps2);
// The same of a vehicle that accelerates by so much now, and comes to start_mps2 by a jerk.
struct Setting {
  double acceleration_mps2 = 0.0, jerk_mps3 = 3.0;
};
// jerk_mps3 is over 0.
double TravelTime(double distance_m, double speed_mps, double most_mps, double start_mps2, const Setting& off);

}  // namespace rodeira::traffic

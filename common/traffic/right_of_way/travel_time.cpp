// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/travel_time.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::traffic {
namespace {

constexpr double kMinTopSpeed_mps = 0.5;

}  // namespace

double TravelTime(double distance_m, double speed_mps, double most_mps, double start_mps2) {
  if (distance_m <= 0.0) return 0.0;
  const double v = speed_mps, top = std::max({most_mps, v, kMinTopSpeed_mps});
  const double gaining = (top * top - v * v) / (2.0 * start_mps2);
  if (distance_m >= gaining) return (top - v) / start_mps2 + (distance_m - gaining) / top;
  return (std::sqrt(v * v + 2.0 * start_mps2 * distance_m) - v) / start_mps2;
}

// Until the rate is reached it loses speed Δ²/(2 j), of the time that this takes at all, and way Δ³/(6 j²) beside, Δ
// what is still to gain of the rate: as if it began slower, and so much nearer.
double TravelTime(double distance_m, double speed_mps, double most_mps, double start_mps2, const Setting& off) {
  if (distance_m <= 0.0) return 0.0;
  const double gains = std::max(0.0, start_mps2 - off.acceleration_mps2), j = off.jerk_mps3;
  const double top = std::max({most_mps, speed_mps, kMinTopSpeed_mps}), v = speed_mps - gains * gains / (2.0 * j);
  const double way = distance_m - gains * gains * gains / (6.0 * j * j), at_speed = distance_m / top;
  const double gaining = (top * top - v * v) / (2.0 * start_mps2);
  if (way >= gaining) return std::max(at_speed, (top - v) / start_mps2 + (way - gaining) / top);
  return std::max(at_speed, (std::sqrt(std::max(0.0, v * v + 2.0 * start_mps2 * way)) - v) / start_mps2);
}

}  // namespace rodeira::traffic

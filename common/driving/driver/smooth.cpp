// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/smooth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rodeira::driver {
namespace {

constexpr double kLonger_m = 0.25;

}  // namespace

double EasedStop_mps2(double speed_mps, double jerk_mps3, double dt_s) {
  const double step = jerk_mps3 * dt_s, v = std::max(0.0, speed_mps) / (step * dt_s);
  const double steps = 0.5 * (std::sqrt(1.0 + 8.0 * v) - 1.0);
  const double n =
      steps < 1e15 ? static_cast<double>(static_cast<std::int64_t>(steps)) : std::floor(steps);  // in registers
  return step * (n + (v - 0.5 * n * (n + 1.0)) / (n + 1.0));
}

// The deceleration grows from c = -a to p and goes to 0: (2 p² - c²)/(2 j) = v. A vehicle that brakes harder than that
// already can only let go.
double SmoothStop_m(double speed_mps, double acceleration_mps2, double jerk_mps3) {
  const double v = std::max(0.0, speed_mps), j = jerk_mps3, c = -acceleration_mps2;
  if (c > 0.0 && c * c >= 2.0 * j * v) return j / 6.0 * std::pow(2.0 * v / j, 1.5);
  const double p = std::sqrt(j * v + 0.5 * c * c), grows = (p - c) / j, goes = p / j;
  return grows * (v - grows * (0.5 * c + j * grows / 6.0)) + j * goes * goes * goes / 6.0;
}

StopProfile StopIn(double way_m, double braking_mps2, double jerk_mps3) {
  const double x = std::max(0.0, way_m), b = braking_mps2, j = jerk_mps3, eased = b * b * b / (6.0 * j * j);
  if (x > eased) return {std::sqrt(b * b * b * b / (4.0 * j * j) + 2.0 * b * (x - eased)), b};
  const double t = std::cbrt(6.0 * x / j);
  return {0.5 * j * t * t, j * t};
}

bool NeedsHaste(double wanted_mps2, double speed_mps, double acceleration_mps2, double jerk_mps3) {
  if (wanted_mps2 >= 0.0) return false;
  return SmoothStop_m(speed_mps, acceleration_mps2, jerk_mps3) >
         speed_mps * speed_mps / (-2.0 * wanted_mps2) + kLonger_m;
}

}  // namespace rodeira::driver

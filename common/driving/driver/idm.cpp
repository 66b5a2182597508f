// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/idm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rodeira::driver {
namespace {

constexpr double kMinDesired_mps = 0.1;

double FreePart(const IdmSettings& idm, double v, double v0) {
  if (v <= v0) {
    const double ratio = v / v0;
    return idm.acceleration_mps2 * (1.0 - ratio * ratio * ratio * ratio);
  }
  return -idm.braking_mps2 * (1.0 - std::pow(v0 / v, 4.0 * idm.acceleration_mps2 / idm.braking_mps2));
}

}  // namespace

double IdmFreeAcceleration(const IdmSettings& idm, double speed_mps, double desired_mps) {
  return std::max(-idm.max_deceleration_mps2,
                  FreePart(idm, std::max(0.0, speed_mps), std::max(desired_mps, kMinDesired_mps)));
}

double IdmAcceleration(const IdmSettings& idm, double speed_mps, double desired_mps, double gap_m, double leader_mps) {
  if (!(gap_m > 0.0)) return -idm.max_deceleration_mps2;
  const double v = std::max(0.0, speed_mps);
  const double v0 = std::max(desired_mps, kMinDesired_mps);
  const double approach = v * (v - leader_mps) / (2.0 * std::sqrt(idm.acceleration_mps2 * idm.braking_mps2));
  const double wanted = idm.min_gap_m + std::max(0.0, v * idm.time_gap_s + approach);
  const double ratio = wanted / gap_m;
  const double acceleration = FreePart(idm, v, v0) - idm.acceleration_mps2 * ratio * ratio;
  return std::clamp(acceleration, -idm.max_deceleration_mps2, idm.acceleration_mps2);
}

double IdmEquilibriumGap(const IdmSettings& idm, double speed_mps, double desired_mps) {
  const double ratio = speed_mps / std::max(desired_mps, kMinDesired_mps);
  if (ratio >= 1.0) return std::numeric_limits<double>::infinity();
  return (idm.min_gap_m + speed_mps * idm.time_gap_s) / std::sqrt(1.0 - ratio * ratio * ratio * ratio);
}

}  // namespace rodeira::driver

// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/acc.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::driver {
namespace {

constexpr double kCoolness = 0.99;

// The constant acceleration that just avoids a leader that keeps to its own.
double Cah(const IdmSettings& idm, double v, double gap_m, double leader_mps, double leader_mps2) {
  const double a_l = std::min(leader_mps2, idm.acceleration_mps2), opens = leader_mps * (v - leader_mps);
  if (opens < -2.0 * gap_m * a_l) return v * v * a_l / (leader_mps * leader_mps - 2.0 * gap_m * a_l);
  const double closing = std::max(0.0, v - leader_mps);
  return a_l - closing * closing / (2.0 * gap_m);
}

}  // namespace

bool AccIsIdm(const IdmSettings& idm, double speed_mps, double desired_mps, double gap_m, double leader_mps,
              double leader_mps2) {
  return gap_m > 0.0 && IdmAcceleration(idm, speed_mps, desired_mps, gap_m, leader_mps) >=
                            Cah(idm, std::max(0.0, speed_mps), gap_m, leader_mps, leader_mps2);
}

double AccAcceleration(const IdmSettings& idm, double speed_mps, double desired_mps, double gap_m, double leader_mps,
                       double leader_mps2) {
  const double plain = IdmAcceleration(idm, speed_mps, desired_mps, gap_m, leader_mps);
  if (!(gap_m > 0.0)) return plain;
  const double cah = Cah(idm, std::max(0.0, speed_mps), gap_m, leader_mps, leader_mps2);
  if (plain >= cah) return plain;
  const double b = idm.braking_mps2;
  const double eased = (1.0 - kCoolness) * plain + kCoolness * (cah + b * std::tanh((plain - cah) / b));
  return std::clamp(eased, -idm.max_deceleration_mps2, idm.acceleration_mps2);
}

}  // namespace rodeira::driver

// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/tyre_pressure.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kCarcass = 0.2;
constexpr double kExponent = -0.4, kMaxResistance = 10.0;
constexpr double kFlatSlip = 0.35;

}  // namespace

void SetPressure(TyreSettings& tyre, double share) {
  RODEIRA_ASSERT(share >= 0.0 && share <= kMaxPressureShare);
  tyre.vertical_share = kCarcass + (1.0 - kCarcass) * share;
  tyre.resistance_share = share > 0.0 ? std::min(kMaxResistance, std::pow(share, kExponent)) : kMaxResistance;
  tyre.slip_share = std::min(1.0, kFlatSlip + (1.0 - kFlatSlip) * share);
  if (share == 1.0) tyre.vertical_share = tyre.resistance_share = tyre.slip_share = 1.0;
}

}  // namespace rodeira::dynamics

// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/gearbox.hpp"

#include <algorithm>

namespace rodeira::dynamics {
namespace {

constexpr double kClutchPressed = 0.6;
constexpr double kMaxSpeedAgainstGear_mps = 2.0;  // above it no gear of the other direction engages

}  // namespace

int CutGear(const GearboxSettings& gearbox, int gear) {
  return std::clamp(gear, -1, static_cast<int>(gearbox.forward.size()));
}

double TotalRatio(const GearboxSettings& gearbox, int gear) {
  const int cut = CutGear(gearbox, gear);
  if (cut == 0) return 0.0;
  const double ratio = cut < 0 ? -gearbox.reverse : gearbox.forward[static_cast<std::size_t>(cut - 1)];
  return ratio * gearbox.final_drive;
}

int ShiftByHand(const GearboxSettings& gearbox, int engaged, int lever, double clutch_pedal, double speed_mps) {
  const int wanted = CutGear(gearbox, lever);
  if (wanted == engaged || wanted == 0) return wanted;
  if (clutch_pedal < kClutchPressed) return engaged;
  const bool against = wanted < 0 ? speed_mps > kMaxSpeedAgainstGear_mps : speed_mps < -kMaxSpeedAgainstGear_mps;
  return against ? 0 : wanted;
}

}  // namespace rodeira::dynamics

#include "common/traffic/fuel.hpp"

#include <algorithm>

namespace rodeira::traffic {
namespace {

constexpr double kF0 = 493.1, kF1 = 5.054, kF2 = 225.3, kF3 = 0.0, kF4 = 0.03887, kF5 = 42.96, kF6 = 1.113;
constexpr double kRolling_mps = 1.5;
// What slows a car down that is pushed by nothing: rolling resistance 0.012 g, air 0.5 * 1.2 * 0.66 / 1300.
constexpr double kRolling_mps2 = 0.118;
constexpr double kAir_1pm = 3.0e-4;

// Of lorries and buses.
constexpr double kRatedkWpkg = 17.5e-3;
constexpr double kHeavyRolling_mps2 = 0.078, kHeavyAir_kgpm = 3.3, kHeavyEfficiency = 0.93;
constexpr double kIdle_gphkW = 24.0, kLoad_gphkW = 239.0;
constexpr double kMgpsPerGph = 1.0 / 3.6;

}  // namespace

double FuelFlow_mgps(double speed_mps, double acceleration_mps2) {
  const double v = speed_mps, a = acceleration_mps2;
  if (v >= kRolling_mps && a < -(kRolling_mps2 + kAir_1pm * v * v)) return 0.0;
  return std::max(0.0, kF0 + v * (kF1 + v * (kF3 + kF4 * v)) + a * (kF2 + v * (kF5 + kF6 * v)));
}

double FuelFlow_mgps(const AgentTraits& traits, double speed_mps, double acceleration_mps2) {
  if (traits.kind != VehicleKind::kLorry && traits.kind != VehicleKind::kBus) return FuelFlow_mgps(speed_mps, acceleration_mps2);
  const double v = speed_mps, force_N = traits.mass_kg * (acceleration_mps2 + kHeavyRolling_mps2) + kHeavyAir_kgpm * v * v;
  if (v >= kRolling_mps && force_N < 0.0) return 0.0;
  const double power_kW = std::max(0.0, 1e-3 * force_N * v / kHeavyEfficiency);
  return kMgpsPerGph * (kIdle_gphkW * kRatedkWpkg * traits.mass_kg + kLoad_gphkW * power_kW);
}

}  // namespace rodeira::traffic

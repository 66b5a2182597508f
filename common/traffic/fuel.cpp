#include "common/traffic/fuel.hpp"

#include <algorithm>

namespace rodeira::traffic {
namespace {

constexpr double kF0 = 493.1, kF1 = 5.054, kF2 = 225.3, kF3 = 0.0, kF4 = 0.03887, kF5 = 42.96, kF6 = 1.113;
constexpr double kRolling_mps = 1.5;
// What slows a car down that is pushed by nothing: rolling resistance 0.012 g, air 0.5 * 1.2 * 0.66 / 1300.
constexpr double kRolling_mps2 = 0.118;
constexpr double kAir_1pm = 3.0e-4;

}  // namespace

double FuelFlow_mgps(double speed_mps, double acceleration_mps2) {
  const double v = speed_mps, a = acceleration_mps2;
  if (v >= kRolling_mps && a < -(kRolling_mps2 + kAir_1pm * v * v)) return 0.0;
  return std::max(0.0, kF0 + v * (kF1 + v * (kF3 + kF4 * v)) + a * (kF2 + v * (kF5 + kF6 * v)));
}

}  // namespace rodeira::traffic

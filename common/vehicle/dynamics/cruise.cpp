// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/cruise.hpp"

#include <cmath>

namespace rodeira::dynamics {

bool IsCruise(const InitialCondition& initial) {
  return std::fabs(initial.speed_mps) >= kStandstill_mps && initial.lateral_speed_mps == 0.0 &&
         initial.yaw_rate_radps == 0.0;
}

CruiseForces PushAlong(double total_N, const std::array<double, kWheels>& loads_N, const WheelSettings& wheel,
                       bool front_driven, double speed_mps) {
  CruiseForces forces;
  const double resistance = std::copysign(wheel.rolling_resistance, speed_mps);
  double shafts_N = total_N;  // over the rolling radius
  for (std::size_t i = 0; i < kWheels; ++i) {
    forces.longitudinal_N[i] = -resistance * loads_N[i];
    shafts_N -= forces.longitudinal_N[i];
  }
  const std::size_t driven = front_driven ? kFrontLeft : kRearLeft;
  for (std::size_t i = driven; i < driven + 2; ++i) forces.longitudinal_N[i] += 0.5 * shafts_N;
  forces.at_wheel_Nm = 0.5 * shafts_N * wheel.rolling_radius_m;
  return forces;
}

double CruiseMoment(const TyreSettings& tyre, const TyreForces& forces, double vx_mps, double load_N, double friction,
                    double camber_rad) {
  if (!(load_N > 0.0)) return 0.0;
  Tyre rolling;
  const TyreMotion motion = rolling.SetToRollAndBear(tyre, forces, vx_mps, load_N, friction, camber_rad);
  return rolling.Forces(tyre, motion, load_N, friction).aligning_Nm;
}

}  // namespace rodeira::dynamics

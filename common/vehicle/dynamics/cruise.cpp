// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/cruise.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

// Of the shafts' torque: front, rear. An axle slips by (push - resistance of its wheels) over the stiffness of its
// tyres; a centre differential that does not slip makes both alike.
std::array<double, 2> SharesAtSpeed(double shafts_Nm, const std::array<double, kWheels>& loads_N,
                                    const WheelSettings& wheel, const PowertrainSettings& powertrain,
                                    const std::array<TyreSettings, kWheels>& tyres, double speed_mps) {
  const CentreDifferentialSettings& centre = powertrain.centre;
  if (!(shafts_Nm != 0.0)) return AxleShares(powertrain);
  std::array<double, 2> stiffness_N{}, resistance_N{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    if (!(loads_N[i] > 0.0)) continue;
    stiffness_N[AxleOf(i)] += LongitudinalStiffness(tyres[i], loads_N[i]);
    resistance_N[AxleOf(i)] += std::copysign(wheel.rolling_resistance, speed_mps) * loads_N[i];
  }
  const double both_N = stiffness_N[0] + stiffness_N[1];
  if (!(both_N > 0.0)) return AxleShares(powertrain);
  const double shafts_N = shafts_Nm / wheel.rolling_radius_m;
  const double alike_N = resistance_N[0] + stiffness_N[0] / both_N * (shafts_N - resistance_N[0] - resistance_N[1]);
  // The plates pass half of what the axles' torques differ by.
  const double plates_N = 0.5 * LockingTorque(centre.plates, shafts_Nm) / wheel.rolling_radius_m;
  const double open_N = centre.front_share * shafts_N;
  const double front_N = centre.locked ? alike_N : std::clamp(alike_N, open_N - plates_N, open_N + plates_N);
  return {front_N / shafts_N, 1.0 - front_N / shafts_N};
}

}  // namespace

bool IsCruise(const InitialCondition& initial) {
  return std::fabs(initial.speed_mps) >= kStandstill_mps && initial.lateral_speed_mps == 0.0 &&
         initial.yaw_rate_radps == 0.0;
}

CruiseForces PushAlong(double total_N, const std::array<double, kWheels>& loads_N, const WheelSettings& wheel,
                       const PowertrainSettings& powertrain, const std::array<TyreSettings, kWheels>& tyres,
                       double speed_mps) {
  CruiseForces forces;
  const double resistance = std::copysign(wheel.rolling_resistance, speed_mps);
  double shafts_N = total_N;  // over the rolling radius
  for (std::size_t i = 0; i < kWheels; ++i) {
    forces.longitudinal_N[i] = -resistance * loads_N[i];
    shafts_N -= forces.longitudinal_N[i];
  }
  const std::array<double, 2> shares =
      powertrain.driven == DrivenWheels::kAll
          ? SharesAtSpeed(shafts_N * wheel.rolling_radius_m, loads_N, wheel, powertrain, tyres, speed_mps)
          : AxleShares(powertrain);
  for (std::size_t axle = 0; axle < 2; ++axle) {
    if (!Drives(powertrain.driven, axle)) continue;
    const double each_N = 0.5 * shafts_N * shares[axle];
    for (std::size_t i = 2 * axle; i < 2 * axle + 2; ++i) forces.longitudinal_N[i] += each_N;
    forces.at_wheel_Nm[axle] = each_N * wheel.rolling_radius_m;
  }
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

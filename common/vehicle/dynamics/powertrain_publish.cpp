// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/powertrain_publish.hpp"

namespace rodeira::dynamics {

void PublishPowertrain(const Powertrain& powertrain, VehicleState& state) {
  const Engine& engine = powertrain.engine();
  state.engine_speed_radps = engine.speed_radps();
  state.engine_torque_Nm = engine.net_torque_Nm();
  state.engine_running = engine.running();
  state.clutch = powertrain.clutch();
  state.clutch_torque_Nm = powertrain.motion().clutch_torque_Nm;
  state.clutch_slip_radps = powertrain.motion().clutch_slip_radps;
  state.clutch_heat_W = powertrain.motion().clutch_heat_W;
  state.gear = powertrain.gear();
  state.throttle = engine.throttle();
  state.fuel_rate_kgps = engine.fuel_rate_kgps();
  state.fuel_kg = engine.fuel_kg();
}

}  // namespace rodeira::dynamics

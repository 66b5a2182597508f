// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/powertrain.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {

void Powertrain::Start(const PowertrainSettings& settings, double wheel_radps) {
  *this = Powertrain();
  automatic_.Start(settings.automatic, settings.gearbox, wheel_radps);
  gear_ = automatic_.gear();
  const double turned = TotalRatio(settings.gearbox, gear_) * wheel_radps;
  engine_.Start(std::max(settings.engine.idle_radps, turned));
  motion_.engine_radps = engine_.speed_radps();
  motion_.wheel_radps = {wheel_radps, wheel_radps};
  motion_.clutch_slip_radps = engine_.speed_radps() - turned;
}

double ShaftTorque(const GearboxSettings& gearbox, double at_wheel_Nm, double onward) {
  const double wanted = onward * at_wheel_Nm;
  return onward * (wanted > 0.0 ? wanted / gearbox.efficiency : wanted / (2.0 - gearbox.efficiency));
}

void Powertrain::StartSteadily(const PowertrainSettings& settings, double wheel_radps, double at_wheel_Nm) {
  Start(settings, wheel_radps);
  const double ratio = TotalRatio(settings.gearbox, gear_);
  if (ratio * wheel_radps < settings.engine.idle_radps) return;
  motion_.drive_torque_Nm = ShaftTorque(settings.gearbox, at_wheel_Nm, wheel_radps < 0.0 ? -1.0 : 1.0);
  motion_.loss_torque_Nm.fill(at_wheel_Nm - motion_.drive_torque_Nm);
  motion_.clutch_torque_Nm = 2.0 * motion_.drive_torque_Nm / ratio;
  clutch_ = 0.0;
  engine_.Hold(settings.engine, motion_.clutch_torque_Nm);
}

const DrivelineMotion& Powertrain::Step(const PowertrainSettings& settings, const Controls& controls,
                                        const PowertrainInput& input, double dt_s) {
  const double wheel_radps = 0.5 * (input.wheel_radps[0] + input.wheel_radps[1]);
  double throttle = controls.throttle;
  bool starter = controls.starter;
  if (controls.gearbox == GearboxMode::kAutomatic) {
    if (mode_ != GearboxMode::kAutomatic) automatic_.Adopt(gear_);
    const double load_Nm = 2.0 * motion_.drive_torque_Nm - input.inertia_torque_Nm;
    const AutomaticOutput output = automatic_.Step(settings.automatic, settings.gearbox, settings.engine,
                                                   {controls.gear, controls.throttle, engine_.speed_radps(),
                                                    wheel_radps, input.speed_mps, load_Nm, settings.clutch.capacity_Nm},
                                                   dt_s);
    gear_ = output.gear;
    clutch_ = output.clutch;
    throttle = output.throttle;
    starter = starter || !engine_.running();
  } else {
    gear_ = ShiftByHand(settings.gearbox, gear_, controls.gear, controls.clutch, input.speed_mps);
    clutch_ = controls.clutch;
  }
  mode_ = controls.gearbox;
  engine_.Prepare(settings.engine, throttle, starter);

  DrivelineLoads loads;
  loads.ratio = TotalRatio(settings.gearbox, gear_);
  loads.clutch_capacity_Nm = ClutchCapacity(settings.clutch, clutch_);
  // As the losses: by the torque of the step before.
  loads.locking_torque_Nm = LockingTorque(settings.differential, 2.0 * motion_.drive_torque_Nm);
  loads.wheel_inertia_kgm2 = input.wheel_inertia_kgm2;
  loads.wheel_radps = input.wheel_radps;
  loads.road_torque_Nm = input.road_torque_Nm;
  for (std::size_t i = 0; i < 2; ++i) {
    loads.loss_torque_Nm[i] = (1.0 - settings.gearbox.efficiency) * std::fabs(motion_.shaft_torque_Nm()[i]);
    loads.friction_torque_Nm[i] = input.friction_torque_Nm[i] + loads.loss_torque_Nm[i];
  }
  motion_ = StepDriveline(settings.engine, engine_, loads, dt_s);
  engine_.Finish(settings.engine, motion_.engine_radps, dt_s);
  return motion_;
}

void Powertrain::Save(base::StateWriter& writer) const {
  writer.Put("engine", engine_);
  writer.Put("automatic", automatic_);
  writer.Put("mode", mode_);
  writer.Put("gear", gear_);
  writer.Put("clutch", clutch_);
  writer.Put("driveline", motion_);
}

void Powertrain::Restore(base::StateReader& reader) {
  reader.Get("engine", engine_);
  reader.Get("automatic", automatic_);
  reader.Get("mode", mode_);
  reader.Get("gear", gear_);
  reader.Get("clutch", clutch_);
  reader.Get("driveline", motion_);
}

}  // namespace rodeira::dynamics

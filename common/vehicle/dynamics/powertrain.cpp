// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/powertrain.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

constexpr double kLocked_Nm = 1e9;  // more than any axle bears

AxleLoads LoadsOf(const GearboxSettings& gearbox, const DifferentialSettings& differential, const AxleInput& input,
                  const AxleMotion& before) {
  AxleLoads loads;
  // As the losses: by the torque of the step before.
  loads.locking_torque_Nm = LockingTorque(differential, 2.0 * before.drive_torque_Nm);
  loads.wheel_radps = input.wheel_radps;
  loads.road_torque_Nm = input.road_torque_Nm;
  for (std::size_t i = 0; i < 2; ++i) {
    loads.loss_torque_Nm[i] = (1.0 - gearbox.efficiency) * std::fabs(before.shaft_torque_Nm()[i]);
    loads.friction_torque_Nm[i] = input.friction_torque_Nm[i] + loads.loss_torque_Nm[i];
  }
  return loads;
}

}  // namespace

bool Drives(DrivenWheels driven, std::size_t axle) {
  return driven == DrivenWheels::kAll || (driven == DrivenWheels::kFront) == (axle == 0);
}

std::array<double, 2> AxleShares(const PowertrainSettings& settings) {
  if (settings.driven == DrivenWheels::kAll) return {settings.centre.front_share, 1.0 - settings.centre.front_share};
  return settings.driven == DrivenWheels::kFront ? std::array<double, 2>{1.0, 0.0} : std::array<double, 2>{0.0, 1.0};
}

double TurningOf(const PowertrainSettings& settings, const std::array<double, 4>& wheel_radps) {
  double turning = -0.0;  // of one axle it has its bits
  for (std::size_t axle = 0; axle < 2; ++axle) {
    if (!Drives(settings.driven, axle)) continue;
    turning += AxleShares(settings)[axle] * (0.5 * (wheel_radps[2 * axle] + wheel_radps[2 * axle + 1]));
  }
  return turning;
}

void Powertrain::Start(const PowertrainSettings& settings, double wheel_radps) {
  *this = Powertrain();
  automatic_.Start(settings.automatic, settings.gearbox, wheel_radps);
  gear_ = automatic_.gear();
  const double turned = TotalRatio(settings.gearbox, gear_) * wheel_radps;
  engine_.Start(std::max(settings.engine.idle_radps, turned));
  motion_.engine_radps = engine_.speed_radps();
  motion_.wheel_radps = {wheel_radps, wheel_radps};
  motion_.drives_all = settings.driven == DrivenWheels::kAll;
  if (motion_.drives_all) motion_.rear.wheel_radps = motion_.wheel_radps;
  motion_.clutch_slip_radps = engine_.speed_radps() - turned;
}

double ShaftTorque(const GearboxSettings& gearbox, double at_wheel_Nm, double onward) {
  const double wanted = onward * at_wheel_Nm;
  return onward * (wanted > 0.0 ? wanted / gearbox.efficiency : wanted / (2.0 - gearbox.efficiency));
}

void Powertrain::StartSteadily(const PowertrainSettings& settings, double wheel_radps,
                               const std::array<double, 2>& at_wheel_Nm) {
  Start(settings, wheel_radps);
  const double ratio = TotalRatio(settings.gearbox, gear_);
  if (ratio * wheel_radps < settings.engine.idle_radps) return;
  const auto drive = [&](AxleMotion& axle, double wheel_Nm) {
    axle.drive_torque_Nm = ShaftTorque(settings.gearbox, wheel_Nm, wheel_radps < 0.0 ? -1.0 : 1.0);
    axle.loss_torque_Nm.fill(wheel_Nm - axle.drive_torque_Nm);
  };
  drive(motion_, at_wheel_Nm[settings.driven == DrivenWheels::kRear ? 1 : 0]);
  if (settings.driven == DrivenWheels::kAll) drive(motion_.rear, at_wheel_Nm[1]);
  motion_.clutch_torque_Nm = motion_.drive_sum_Nm() / ratio;
  motion_.centre_locking_torque_Nm =
      settings.driven == DrivenWheels::kAll
          ? 4.0 * motion_.drive_torque_Nm - 2.0 * settings.centre.front_share * motion_.drive_sum_Nm()
          : 0.0;
  clutch_ = 0.0;
  engine_.Hold(settings.engine, motion_.clutch_torque_Nm);
}

const DrivelineMotion& Powertrain::Step(const PowertrainSettings& settings, const Controls& controls,
                                        const PowertrainInput& input, double dt_s) {
  const bool drives_all = settings.driven == DrivenWheels::kAll;
  const double front_share = drives_all ? settings.centre.front_share : 1.0;
  double wheel_radps = 0.5 * (input.wheel_radps[0] + input.wheel_radps[1]);
  if (drives_all)
    wheel_radps =
        front_share * wheel_radps + (1.0 - front_share) * 0.5 * (input.rear.wheel_radps[0] + input.rear.wheel_radps[1]);
  double throttle = controls.throttle;
  bool starter = controls.starter;
  if (controls.gearbox == GearboxMode::kAutomatic) {
    if (mode_ != GearboxMode::kAutomatic) automatic_.Adopt(gear_);
    const double load_Nm = motion_.drive_sum_Nm() - input.inertia_torque_Nm;
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
  loads.wheel_inertia_kgm2 = input.wheel_inertia_kgm2;
  static_cast<AxleLoads&>(loads) = LoadsOf(settings.gearbox, settings.differential, input, motion_);
  if (drives_all) {
    loads.drives_all = true;
    loads.front_share = front_share;
    loads.rear = LoadsOf(settings.gearbox, settings.rear_differential, input.rear, motion_.rear);
    loads.centre_locking_torque_Nm =
        settings.centre.locked ? kLocked_Nm : LockingTorque(settings.centre.plates, motion_.drive_sum_Nm());
  }
  motion_ = StepDriveline(settings.engine, engine_, loads, dt_s);
  engine_.Finish(settings.engine, motion_.engine_radps, dt_s);
  return motion_;
}

const AxleMotion* Powertrain::AxleOf(const PowertrainSettings& settings, std::size_t axle) const {
  if (!Drives(settings.driven, axle)) return nullptr;
  return settings.driven == DrivenWheels::kAll && axle == 1 ? &motion_.rear : &motion_;
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

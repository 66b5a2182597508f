// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/core/base/state.hpp"
#include "common/vehicle/dynamics/engine.hpp"

namespace rodeira::dynamics {

// A friction clutch: what it can pass falls linearly with the pedal.
struct ClutchSettings {
  double capacity_Nm = 200.0;
};
double ClutchCapacity(const ClutchSettings& clutch, double pedal);  // pedal 0 engaged … 1 disengaged

// A differential with clutch plates that resist a difference of its shafts' speeds with a torque of at most this much
// between the two shafts: preload + locking × |sum of both shafts|. All 0: open. A locking value S is |T_left -
// T_right| / (T_left + T_right) while one wheel slips, as makers state it: without preload the better wheel gets up to
// (1 + S)/(1 - S) of the worse one's torque.
struct DifferentialSettings {
  double preload_Nm = 0.0;
  double locking_drive = 0.0;    // while the engine drives, 0 … 1
  double locking_overrun = 0.0;  // while the wheels drive the engine, 0 … 1
};
// A positive sum drives the car. At least 0.
double LockingTorque(const DifferentialSettings& differential, double sum_of_shafts_Nm);

// A differential between two driven axles: a planetary gear that gives the front axle a fixed share of the torque, with
// the same plates as that of an axle. A locked one turns both axles alike and lets the tyres share the torque.
struct CentreDifferentialSettings {
  double front_share = 0.5;  // of the torque while nothing locks, in (0, 1)
  bool locked = false;
  DifferentialSettings plates;
};

// Of a driven axle: left, right.
struct AxleLoads {
  double locking_torque_Nm = 0.0;  // the most that the shafts' torques differ by; 0: an open differential
  std::array<double, 2> wheel_radps{};
  std::array<double, 2> road_torque_Nm{};  // of the tyres on the wheels, positive forward
  std::array<double, 2>
      friction_torque_Nm{};                // brake, rolling resistance, losses: at most this much against the rotation
  std::array<double, 2> loss_torque_Nm{};  // the gears' part of it
};

// One step's loads on engine, clutch, gears, differentials and driven wheels: those of the only driven axle or, with
// all wheels driven, of the front one.
struct DrivelineLoads : AxleLoads {
  double ratio = 0.0;  // engine turns a turn of the wheels, negative in reverse, 0 in neutral
  double clutch_capacity_Nm = 0.0;
  double wheel_inertia_kgm2 = 1.0;  // each
  bool drives_all = false;
  double front_share = 1.0;               // of the torque, by the centre differential; 1 with one driven axle
  double centre_locking_torque_Nm = 0.0;  // the most that the axles' torques differ by beside their shares
  AxleLoads rear;
};

// What a step found for a driven axle: left, right; positive forward.
struct AxleMotion {
  std::array<double, 2> wheel_radps{};
  std::array<double, 2> friction_torque_Nm{};  // acting, either sign
  std::array<double, 2> loss_torque_Nm{};      // the gears' part of it
  double drive_torque_Nm = 0.0;                // of a drive shaft in the mean of both
  double locking_torque_Nm = 0.0;              // left shaft - right shaft

  // Of each shaft on its wheel: left, right.
  std::array<double, 2> shaft_torque_Nm() const {
    return {drive_torque_Nm + 0.5 * locking_torque_Nm, drive_torque_Nm - 0.5 * locking_torque_Nm};
  }

  // The same less the gears' losses.
  std::array<double, 2> wheel_torque_Nm() const {
    return {shaft_torque_Nm()[0] + loss_torque_Nm[0], shaft_torque_Nm()[1] + loss_torque_Nm[1]};
  }
};

// Of the only driven axle or, with all wheels driven, of the front one.
struct DrivelineMotion : AxleMotion {
  double engine_radps = 0.0;
  double locking_heat_W = 0.0;     // of the plates of all differentials
  double clutch_torque_Nm = 0.0;   // from engine to gearbox, either sign
  double clutch_slip_radps = 0.0;  // at the end of the step
  double clutch_in_W = 0.0;        // torque × mean speed of the engine
  double clutch_out_W = 0.0;       // torque × mean speed of the gearbox's input
  double clutch_heat_W = 0.0;      // in - out
  bool drives_all = false;
  double centre_locking_torque_Nm = 0.0;  // front axle - rear axle, beside their shares
  AxleMotion rear;

  // Of all drive shafts together.
  double drive_sum_Nm() const { return 2.0 * (drives_all ? drive_torque_Nm + rear.drive_torque_Nm : drive_torque_Nm); }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

// Engine, clutch and driven wheels as rigid rotors joined by dry friction, solved at the end-of-step speeds: what
// sticks sticks exactly, brakes never turn a wheel back, a locked clutch or differential does not slip. Over the step
// the work balances to rounding: change of kinetic energy = engine + road - friction - heat of clutch and
// differentials, torques × mean speeds.
DrivelineMotion StepDriveline(const EngineSettings& settings, const Engine& engine, const DrivelineLoads& loads,
                              double dt_s);

// A wheel by itself, without a drive shaft. Returns its new speed; `friction_Nm` becomes what acted.
double StepFreeWheel(double wheel_radps, double inertia_kgm2, double road_torque_Nm, double& friction_Nm, double dt_s);

}  // namespace rodeira::dynamics

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/base/state.hpp"

namespace rodeira::dynamics {

inline constexpr double kPetrol_kgpl = 0.745;

// A point of the full-load curve.
struct TorqueSample {
  double speed_radps = 0.0;
  double torque_Nm = 0.0;
};

// A petrol engine; speeds are the crankshaft's.
struct EngineSettings {
  std::vector<TorqueSample> full_load;  // ascending in speed, net torque at full throttle
  std::vector<double> full_load_Nmspr;  // slopes at the samples (SmoothSlopes): cubic between them; empty: linear
  double inertia_kgm2 = 0.2;            // with the flywheel
  double drag_Nm = 14.0;                // torque to turn it without combustion: drag + drag_Nmspr · speed
  double drag_Nmspr = 0.012;
  double idle_radps = 89.0;
  double stall_radps = 40.0;      // below it combustion ends
  double cut_radps = 680.678;     // the limiter cuts the fuel from here (6500 rpm) …
  double resume_radps = 659.734;  // … until the speed has fallen to here (6300 rpm)
  double starter_Nm = 45.0;
  double indicated_efficiency = 0.35;  // of combustion, for the fuel
  double heating_value_Jpkg = 42.7e6;  // of the fuel
  double throttle_fuel_kgps =
      0.0;  // over 0: what full throttle burns, in proportion to the throttle, instead of Willans' line
};

// Slopes of a smooth curve through the samples that rises and falls only where they do (F. N. Fritsch, R. E. Carlson,
// SIAM Journal on Numerical Analysis 17 (1980) 238-246).
std::vector<double> SmoothSlopes(const std::vector<TorqueSample>& samples);

// Full-load torque: linear, or smooth, between samples; below the first linear to 0 at 0; above the last it keeps the
// last value.
double FullLoadTorque(const EngineSettings& engine, double speed_radps);
// Drag torque, at least 0, the same for either direction.
double DragTorque(const EngineSettings& engine, double speed_radps);

// Combustion, idle control, limiter, starter, stall, fuel. The speed itself is advanced by the driveline.
//   indicated torque = theta (full load + drag);  net torque = indicated - drag;
// with idle control's theta_i and the pedal p: theta = theta_i + (1 - theta_i) p, so that any pedal gives more than
// idling takes. An open throttle gives the curve and a closed one the drag (overrun). Fuel by Willans' line: burnt
// power = indicated power / efficiency, that is zero in overrun, and at rest what idling takes.
class Engine {
 public:
  void Start(double speed_radps);  // running at this speed, nothing burnt yet
  // After Start: with the throttle at which it gives this torque at the flywheel, as far as it can.
  void Hold(const EngineSettings& engine, double torque_Nm);

  // Decides running, limiter and throttle for the coming step. `throttle` is the driver's or the gear change's.
  void Prepare(const EngineSettings& engine, double throttle, bool starter);
  // Torques for the step: combustion and starter push, drag is a friction (it can stop the engine, not turn it back).
  double driving_Nm() const { return indicated_Nm_ + starter_Nm_; }
  double drag_Nm() const { return drag_Nm_; }
  // Ends the step at a new speed; counts the fuel.
  void Finish(const EngineSettings& engine, double speed_radps, double dt_s);

  double speed_radps() const { return speed_radps_; }
  bool running() const { return running_; }
  double throttle() const { return throttle_; }  // theta, idle control included
  double net_torque_Nm() const { return driving_Nm() - drag_Nm_; }
  double fuel_rate_kgps() const { return fuel_rate_kgps_; }
  double fuel_kg() const { return fuel_kg_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  double speed_radps_ = 0.0;
  bool running_ = false;
  bool limited_ = false;
  double throttle_ = 0.0;
  double indicated_Nm_ = 0.0;
  double starter_Nm_ = 0.0;
  double drag_Nm_ = 0.0;
  double fuel_rate_kgps_ = 0.0;
  double fuel_kg_ = 0.0;
};

}  // namespace rodeira::dynamics

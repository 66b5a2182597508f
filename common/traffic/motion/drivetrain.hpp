// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>

#include "common/vehicle/dynamics/bicycle_settings.hpp"

namespace rodeira::traffic {

// What pedals, gear and engine do while a car moves.
struct Driving {
  double throttle = 0.0;  // 0 … 1
  double brake = 0.0;     // 0 … 1
  double clutch = 0.0;    // 0 engaged … 1 disengaged
  double engine_radps = 0.0;
  int gear = 1;         // 1 … n
  double gear_s = 0.0;  // since it was engaged
};

// What its engine can do at a speed, and what it takes to turn it.
struct Torques {
  double full_Nm = 0.0, drag_Nm = 0.0;

  Torques(const dynamics::EngineSettings& engine, double radps);
  // At the flywheel, N m; throttle from 0 to 1. Negative: the engine brakes.
  double Net(double throttle) const { return throttle * (full_Nm + drag_Nm) - drag_Nm; }
};

// The planar car: the powertrain of common/vehicle/dynamics in its steady state, through which pedals move a body along
// its path. What is asked of it in every step is found once; the settings must outlive it.
class PlanarCar {
 public:
  PlanarCar(const dynamics::BicycleSettings& of);  // NOLINT: a car of the vehicle library is one

  const dynamics::BicycleSettings& settings() const { return *settings_; }
  int gears() const { return static_cast<int>(ratios_.size()); }
  // Gears beyond the ends count as the nearest one.
  double Ratio(int gear) const {
    return ratios_[static_cast<std::size_t>(std::clamp(gear, 1, gears()) - 1)];
  }  // the engine's speed over the wheels'
  double full_brake_N() const { return full_brake_N_; }
  const Torques& idling() const { return idling_; }  // at idle speed

 private:
  const dynamics::BicycleSettings* settings_;
  boost::container::small_vector<double, 8> ratios_;
  double full_brake_N_;
  Torques idling_;
};

// The pedals and the gear for an acceleration at this speed on this grade (rise over plan distance), against rolling
// resistance and air: the highest gear in which the engine neither labours nor is too weak; below idle speed the clutch
// slips in the first gear. What the closed throttle does not slow down by, the brake does; at a stand the foot is on
// it.
Driving DrivingFor(const PlanarCar& car, double speed_mps, double acceleration_mps2, double grade);
// The same of a car that has driven so for dt_s, with the vehicle's automatic gearbox's numbers (AutomaticSettings): at
// once into a lower gear where the engine labours or is too weak; into a higher one pause_s after the last change,
// where its engine speed and pull are `margin` times what they must be, so that it is not left again, and not while the
// foot is off the throttle. Sooner only where the engine would run too fast.
Driving DriveOn(const PlanarCar& car, const Driving& before, double speed_mps, double acceleration_mps2, double grade,
                double dt_s);
// What these pedals give, by the torque curve and the drag of the engine, the gears and their losses, the brakes of
// four wheels, the drag of the air. A car at rest is held by its brake.
double AccelerationOf(const PlanarCar& car, const Driving& driving, double speed_mps, double grade);
// What its engine burns then, mg/s: Willans' line as dynamics::Engine counts it; 0 in overrun, and what idling takes
// while the clutch slips.
double FuelFlow_mgps(const PlanarCar& car, const Driving& driving);
// The three of them of one step, to the bit, of an engine that is asked once.
struct Driven {
  Driving driving;
  double acceleration_mps2 = 0.0, fuel_mgps = 0.0;
};
// Speed in m/s, forward; the grade is positive uphill; `before`: of the last step.
Driven Drive(const PlanarCar& car, const Driving& before, double speed_mps, double acceleration_mps2, double grade,
             double dt_s);

// What may be wanted of a car that has driven so, at this speed and acceleration, that the change into the next gear,
// which comes where its engine may turn no faster, takes nothing away at once: what that gear gives there, and as much
// more as nine tenths of `jerk_mps3` take away until then. 1e3 where no such change is near.
double AtMostBeforeChange_mps2(const PlanarCar& car, const Driving& before, double speed_mps, double acceleration_mps2,
                               double grade, double jerk_mps3);

// What all four wheels push back with the pedal to the floor, while they roll.
double FullBrake_N(const dynamics::BicycleSettings& car);

inline constexpr double kFuelDensity_mgpl = 1e6 * dynamics::kPetrol_kgpl;

}  // namespace rodeira::traffic

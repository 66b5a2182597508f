// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/plot/table.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

// The usual tests of a car, with any vehicle model, on a ground without end, without a network.
namespace rodeira::manoeuvres {

// One number of a result. A manoeuvre that does not come to it leaves it out.
struct Figure {
  std::string name;
  double value = 0.0;
  std::string unit;
};

// What came of a manoeuvre.
struct Outcome {
  plot::Table table;  // over time, each 10 ms
  std::vector<Figure> figures;
  std::vector<std::string> missing = {};  // figures that the manoeuvre did not come to, each with the reason

  // Null where the manoeuvre did not come to it.
  const Figure* Find(std::string_view name) const;
};

// One of these tests, by its name.
struct Manoeuvre {
  std::string name;
  std::string what;  // for people, in a line
  // Drives the model, which is placed anew. Failed where the car cannot be placed or does not come to what is to be
  // measured.
  std::function<base::Result<Outcome>(dynamics::VehicleModel& car, double step_s)> drive;
};

// In the order in which they are shown.
const std::vector<Manoeuvre>& Manoeuvres();
// Wrong input that names the nearest one.
base::Result<const Manoeuvre*> FindManoeuvre(const std::string& name);

// Drives it. Failed, with the model's own word, where the model has failed on the way (VehicleModel::problem).
base::Result<Outcome> Drive(const Manoeuvre& manoeuvre, dynamics::VehicleModel& car, double step_s);

// Acceleration from rest with the throttle on the floor, in automatic mode: 0-100 km/h, 0-400 m, top speed. The search
// for the top speed ends where the gains of speed, as they shrink, have less than 0.002 km/h to come.
base::Result<Outcome> Acceleration(dynamics::VehicleModel& car, double step_s);
// From 100 km/h to rest with the brake on the floor: distance, mean deceleration v²/2d, drift.
base::Result<Outcome> Braking(dynamics::VehicleModel& car, double step_s);
// The same from 80 km/h with the right wheels on ice of friction 0.3 and the steering held straight. A car that turns
// by more than 86 degrees before it rests has no distance.
base::Result<Outcome> SplitFriction(dynamics::VehicleModel& car, double step_s);
// From 50 km/h on such a road with hands that hold the lane, after UN R13-H, annex 6: also how far they turn the
// steering wheel in the first two seconds and in all.
base::Result<Outcome> SplitSteered(dynamics::VehicleModel& car, double step_s);
// A circle of 40 m, faster and faster (after ISO 4138): understeer gradient (change of the front wheels' angle over
// that of lateral acceleration) and roll gradient between 1 and 4 m/s², largest lateral acceleration.
base::Result<Outcome> ConstantRadius(dynamics::VehicleModel& car, double step_s);
// At 100 km/h the steering wheel is turned in 0.1 s to the angle that ends at 4 m/s² (after ISO 7401): gain, overshoot,
// times.
base::Result<Outcome> StepSteer(dynamics::VehicleModel& car, double step_s);
// At 80 km/h the steering wheel goes to and fro at 0.5 Hz, for about 2 m/s²: gain and delay of yaw rate and lateral
// acceleration, from the third period on.
base::Result<Outcome> Sine(dynamics::VehicleModel& car, double step_s);
// At 80 km/h with the clutch out one sine of the steering wheel of 0.7 Hz that dwells for 0.5 s at its second peak (UN
// R140, annex 3), with 6.5 times the angle at which the car slowly comes to 0.3 g, at least 270 and at most 300
// degrees: yaw rate over its second peak 1.00 and 1.75 s after the steering has ended, displacement 1.07 s after it
// began.
base::Result<Outcome> SineWithDwell(dynamics::VehicleModel& car, double step_s);
// At 80 km/h into the lane 3.5 m to the left and back, sections of 15, 30, 25, 25 and 30 m (after ISO 3888-1), by a
// driver who looks ahead: how far it strays, largest lateral acceleration and steering speed.
base::Result<Outcome> LaneChange(dynamics::VehicleModel& car, double step_s);
// A minute on a slope of 20 % with the handbrake pulled: how far it creeps.
base::Result<Outcome> Park(dynamics::VehicleModel& car, double step_s);
// At 40 km/h over a bump of 5 cm, half a metre long: accelerations, loads, when it has calmed down.
base::Result<Outcome> Bump(dynamics::VehicleModel& car, double step_s);

}  // namespace rodeira::manoeuvres

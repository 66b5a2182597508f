// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/result.hpp"
#include "common/core/plot/table.hpp"
#include "common/driving/manoeuvres/proving_ground.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::manoeuvres {

// A car on the proving ground, driven step by step and written down each 10 ms.
class Trial {
 public:
  // The model is placed anew, heading along x, with B's origin above the world's.
  static base::Result<Trial> Begin(dynamics::VehicleModel& car, const ProvingGroundSettings& ground, double speed_mps,
                                   double step_s);

  // Controls held for one step of the trial.
  void Step(const dynamics::Controls& controls);

  double time_s() const { return static_cast<double>(steps_) * step_s_; }
  double step_s() const { return step_s_; }
  const dynamics::VehicleState& state() const { return car_->state(); }
  const dynamics::VehicleDimensions& dimensions() const { return car_->dimensions(); }
  // Horizontal acceleration across the car, positive to the left: yaw rate times speed and the change of sideslip.
  double lateral_mps2() const;
  const plot::Table& table() const { return table_; }

 private:
  Trial(dynamics::VehicleModel& car, const ProvingGroundSettings& ground, double step_s);
  void Write();

  dynamics::VehicleModel* car_;
  ProvingGround ground_;
  double step_s_;
  long steps_ = 0;
  long rows_ = 0;
  dynamics::Controls controls_;
  plot::Table table_;
};

// The foot on the pedals that keeps a speed, in automatic mode: proportional and integral.
class SpeedHold {
 public:
  // The wanted speed may change from step to step.
  void Press(double wanted_mps, const Trial& trial, dynamics::Controls& controls);

 private:
  double integral_ = 0.0;
};

}  // namespace rodeira::manoeuvres

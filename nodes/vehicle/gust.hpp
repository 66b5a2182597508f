// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/state.hpp"
#include "common/driving/scenario/event.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::nodes {

// What wind of this velocity (in W, m/s) adds to the air's resistance on a car, across it, as on a plate of its side:
// rho / 2 × area of the side × its speed through the air. The area is 0.8 × length × height; the force acts at half the
// height and at a tenth of the length before the middle of the wheelbase. These are round numbers for a common body,
// not measured on a car. What the wind does along the car is left out.
dynamics::Wrench SideWind(const dynamics::VehicleState& car, const dynamics::VehicleDimensions& dimensions,
                          const Eigen::Vector2d& wind_W_mps);

// A gust that meets a car: its speed is peak × (1 - cos(2 pi t / T)) / 2.
class Gust {
 public:
  // It replaces one that blows.
  void Begin(const scenario::GustChoice& gust, double peak_mps);
  // Of the wind in the middle of a step, in W; then the step is over.
  Eigen::Vector2d Step(double dt_s);
  bool blows() const { return elapsed_s_ < for_s_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  double peak_mps_ = 0.0;
  double to_rad_ = 0.0;  // where it blows to
  double for_s_ = 0.0;
  double elapsed_s_ = 0.0;
};

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/state.hpp"

namespace rodeira::driver {

// How the driver turns a wanted acceleration into pedals.
struct PedalSettings {
  double power_Wpkg = 42.0;        // of the car at full throttle, for the first guess …
  double most_mps2 = 3.5;          // … which at low speed is no more than this
  double full_brake_mps2 = 11.0;   // deceleration with the brake to the floor
  double coasting_mps2 = 0.35;     // deceleration with both pedals released, over rolling and air
  double rolling_mps2 = 0.12;      // rolling resistance over mass
  double air_1pm = 0.00029;        // air drag over mass and v²
  double follow_1ps = 1.5;         // pedal for a speed that lags behind the wanted one
  double trim_1ps2 = 0.3;          // and for one that keeps lagging
  double throttle_rate_1ps = 2.5;  // how fast the foot moves
  double brake_rate_1ps = 5.0;
  double holding_brake = 0.35;  // while standing
};

// A foot that makes the car accelerate as wanted: a guess of throttle or brake from the car's rough measures, corrected
// by what the speed does. While the car stands, the brake holds it.
class Pedals {
 public:
  static constexpr double kGoes_mps2 =
      0.25;  // the foot lets a car that it holds go only where more than this is wanted
  static constexpr double kEnds_mps =
      0.25;  // slower than this, and not wanted to go, the foot ends the stop by itself and holds

  // One step. `wanted_mps2` along the car, `speed_mps` forward, `grade` uphill positive.
  void Step(const PedalSettings& settings, double wanted_mps2, double speed_mps, double grade, double dt_s);
  // Goes on with the pedals as they are, of a car that may be moving.
  void InitialiseFrom(double throttle, double brake);
  // The same at a speed that is as it was wanted.
  void InitialiseFrom(double throttle, double brake, double speed_mps);
  double throttle() const { return throttle_; }
  double brake() const { return brake_; }
  // The speed that the wanted accelerations have led to, which the foot keeps to; 0 while it holds the car.
  double reference_mps() const { return reference_mps_; }
  // Whether the foot holds the car, or lets it roll out its last hand's breadth, whatever is wanted.
  bool holds() const { return standing_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  double throttle_ = 0.0;
  double brake_ = 0.0;
  double reference_mps_ = 0.0;  // the speed that the wanted accelerations would have led to
  double trim_mps2_ = 0.0;
  bool standing_ = true;
};

}  // namespace rodeira::driver

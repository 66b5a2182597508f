// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/state.hpp"

namespace rodeira::dynamics {

// One axle's springs, a wheel; rates are those at the wheel.
struct SuspensionSettings {
  double spring_Npm = 20000.0;
  double damper_Nspm = 1500.0;
  double anti_roll_Npm = 5000.0;  // force for a difference in travel between the axle's wheels
  double bump_m = 0.08;           // travel from rest to the stop, up
  double rebound_m = 0.08;        // and down
};

// What acts on one wheel carrier during a step.
struct CornerInput {
  double static_load_N = 0.0;   // spring's preload: what it bears at zero travel
  double tyre_Npm = 180000.0;   // vertical stiffness
  double free_gap_m = 0.0;      // tyre deflection that zero travel would give, negative in the air; along the strut
  double lean = 1.0;            // cosine between strut and ground normal
  double other_travel_m = 0.0;  // of the axle's other wheel, at the beginning of the step
  double bottom_m = 0.15;       // deflection of the tyre at which the rim bears; the load grows no further
};

// A wheel carrier without mass between tyre and strut: spring, damper and anti-roll bar balance the tyre's force at
// each instant. Its travel (compression positive, 0 at rest) is its only state; implicit, so no rate is too stiff.
class Corner {
 public:
  // Finds travel and load at the end of a step of dt_s.
  void Step(const SuspensionSettings& suspension, const CornerInput& input, double dt_s);
  // Static: travel at which spring and bar balance the tyre.
  void Settle(const SuspensionSettings& suspension, const CornerInput& input);

  double travel_m() const { return travel_m_; }
  double load_N() const { return load_N_; }              // of the tyre on the ground, along its normal
  double suspension_N() const { return suspension_N_; }  // spring, bar, damper, stop: what the strut passes
  double damper_N() const { return damper_N_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  void Bear(const SuspensionSettings& suspension, const CornerInput& input, double damping_Nspm, double before_m);

  double travel_m_ = 0.0;
  double load_N_ = 0.0;
  double suspension_N_ = 0.0;
  double damper_N_ = 0.0;
};

}  // namespace rodeira::dynamics

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/state.hpp"
#include "common/vehicle/dynamics/engine.hpp"
#include "common/vehicle/dynamics/gearbox.hpp"

namespace rodeira::dynamics {

// A manual gearbox worked by the car. Engine speeds in rad/s; the law's speeds lie on a line between a light and a full
// throttle pedal.
struct AutomaticSettings {
  double up_light_radps = 240.0;    // 2292 rpm
  double up_full_radps = 628.0;     // 5997 rpm
  double down_light_radps = 120.0;  // 1146 rpm
  double down_full_radps = 293.0;   // 2798 rpm
  double margin = 1.08;             // distance that a new gear must keep from the law that would leave it again
  double pause_s = 1.5;             // between two changes; not kept where the engine would over-rev or labour
  double open_s = 0.12;             // clutch out
  double swap_s = 0.15;             // at most, to bring the engine to the new gear's speed
  double close_s = 0.35;            // clutch in
  double press_s = 0.3;             // smoothing of the pedal for the law when pressed …
  double release_s = 2.0;           // … and when released: no change up for a short lift of the foot
  double bite_radps = 100.0;        // the clutch starts to pass torque at this engine speed …
  double closed_radps = 250.0;      // … and is closed from here on
};

// What the law looks at.
struct AutomaticInput {
  int selector = 0;  // negative R, 0 N, positive D
  double throttle = 0.0;
  double engine_radps = 0.0;
  double wheel_radps = 0.0;  // mean of the driven wheels
  double speed_mps = 0.0;    // forward
  double load_Nm = 0.0;      // torque at the wheels that keeps the speed: drive torque - mass × radius × acceleration
  double clutch_capacity_Nm = 200.0;
};

// What it does to clutch, gear and throttle during the coming step.
struct AutomaticOutput {
  int gear = 0;
  double clutch = 1.0;  // as a pedal: 0 engaged … 1 disengaged
  double throttle = 0.0;
};

// Chooses the gear and works the clutch. It does not hunt: a higher gear is entered only where it can bear the load and
// its own law would keep it at the pedal which that takes; where the present pedal keeps the speed in this gear but not
// in the higher one, the gear stays; and a gear that was too weak at some pedal is not tried again until the pedal or
// the load has changed. At low speed the clutch closes with the engine's speed, so that the car starts smoothly and
// does not stall; below that it passes a torque by the pedal, so that the car can be manoeuvred. Without a pedal it
// does not creep.
class AutomaticGearbox {
 public:
  // Begins in a gear that suits wheels turning at this speed.
  void Start(const AutomaticSettings& settings, const GearboxSettings& gearbox, double wheel_radps);
  // What holds during the coming step of dt_s; call it once a step.
  AutomaticOutput Step(const AutomaticSettings& settings, const GearboxSettings& gearbox, const EngineSettings& engine,
                       const AutomaticInput& input, double dt_s);
  // Takes over from a driver who has left this gear engaged.
  void Adopt(int gear);
  int gear() const { return gear_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  enum class Phase : std::uint32_t { kDrive, kOpen, kSwap, kClose };

  int Wanted(const AutomaticSettings& settings, const GearboxSettings& gearbox, const EngineSettings& engine,
             const AutomaticInput& input) const;
  int WantedForward(const AutomaticSettings& settings, const GearboxSettings& gearbox, const EngineSettings& engine,
                    const AutomaticInput& input) const;
  bool MayShiftUp(const AutomaticSettings& settings, const GearboxSettings& gearbox, const EngineSettings& engine,
                  const AutomaticInput& input) const;
  void Advance(const AutomaticSettings& settings, const GearboxSettings& gearbox, const AutomaticInput& input,
               double dt_s);
  double ThrottleFor(const AutomaticSettings& settings, const GearboxSettings& gearbox,
                     const AutomaticInput& input) const;

  std::int32_t gear_ = 0;    // engaged
  std::int32_t target_ = 0;  // of the change under way
  Phase phase_ = Phase::kDrive;
  double phase_s_ = 0.0;        // time in this phase
  double driven_s_ = 0.0;       // time since the last change
  double load_Nm_ = 0.0;        // the input's, smoothed
  double pedal_ = 0.0;          // the throttle pedal as the law sees it: follows a press quickly, a release slowly
  std::int32_t weak_gear_ = 0;  // left downward under load …
  double weak_throttle_ = 0.0;  // … at this pedal
};

}  // namespace rodeira::dynamics

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/state.hpp"
#include "common/vehicle/dynamics/controls.hpp"
#include "common/vehicle/input_devices/gear_selector.hpp"
#include "common/vehicle/input_devices/signals.hpp"

namespace rodeira::input_devices {

enum class PadButton : std::size_t {
  kGearUp,
  kGearDown,
  kGearboxMode,
  kHandbrake,
  kStarter,
  kIndicateLeft,
  kIndicateRight,
  kHazard,
  kHeadlights,
  kHorn,
  kCamera,
  kPause
};
inline constexpr std::size_t kPadButtons = 12;

// State of a game pad.
struct PadReading {
  bool connected = false;
  double stick = 0.0;                  // -1 left … 1 right
  double throttle = 0.0, brake = 0.0;  // 0 … 1
  bool down[kPadButtons] = {};

  bool Down(PadButton button) const { return down[static_cast<std::size_t>(button)]; }
};

// Defaults of this project; no set-up is needed.
struct PadSettings {
  double lock_rad = 7.85;            // of the steering wheel, at rest
  double half_lock_speed_mps = 6.5;  // speed at which half of it is available
  double turn_s = 0.5;               // from straight ahead to the lock of that speed
  double centre_s = 0.3;             // from the lock back to straight ahead
  double stick_dead_zone = 0.12;     // share of a side
  double stick_exponent = 1.6;       // finer next to the middle
  double trigger_dead_zone = 0.04;
  std::int32_t gears = 5;
};

// A driver with a game pad. The stick sets the target angle of the steering wheel, between the locks of the present
// speed (LockAt). The wheel turns to it at no more than lock(v) / turn_s outwards and lock(v) / centre_s back, to
// exactly 0 when the stick is released. Triggers are pedals. If the pad is disconnected, pedals are released and the
// steering angle is held.
class PadDriver {
 public:
  explicit PadDriver(const PadSettings& settings = {}) : settings_(settings), lever_(settings.gears) {
    lever_.Show(controls_);
  }

  // The controls dt_s (over 0) later; `engaged` is the gear that is in, `speed_mps` the car's, forward.
  dynamics::Controls Step(const PadReading& pad, std::int32_t engaged, double speed_mps, double dt_s);
  const dynamics::Controls& controls() const { return controls_; }
  Signals signals() const { return signals_.signals(); }
  // Takes over steering angle and gear lever from another source; pedals are released.
  void InitialiseFrom(const dynamics::Controls& last, const Signals& signals = {});

  void Save(base::StateWriter& out) const;
  void Restore(base::StateReader& in);

 private:
  std::uint32_t Presses(const PadReading& pad, PadButton button);

  PadSettings settings_;
  GearSelector lever_;
  SignalSwitch signals_;
  bool down_[kPadButtons] = {};
  dynamics::Controls controls_;
};

}  // namespace rodeira::input_devices

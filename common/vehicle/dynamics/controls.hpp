// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/state.hpp"

namespace rodeira::dynamics {

// Who works clutch and gears. The number is on the wire and in recordings: never renumber.
enum class GearboxMode : std::uint32_t {
  kAutomatic = 0,  // the car: `gear` is the selector (R, N, D), the clutch pedal is ignored
  kManual = 1,     // the driver: `gear` is the lever, `clutch` the pedal
};

// What the driver's hands and feet do, held during one step. Values out of range are cut to it, NaN counts as 0.
struct Controls {
  double steering_wheel_rad = 0.0;  // angle of the steering wheel, positive to the left, 0 straight ahead
  double throttle = 0.0;            // 0 released … 1 to the floor
  double brake = 0.0;               // 0 released … 1 to the floor
  double clutch = 0.0;              // 0 released (engaged) … 1 to the floor (disengaged); manual mode only
  double handbrake = 0.0;           // 0 released … 1 fully pulled
  // -1 reverse, 0 neutral, 1 … n forward. Automatic mode reads the sign only: negative R, zero N, positive D.
  std::int32_t gear = 1;
  GearboxMode gearbox = GearboxMode::kAutomatic;
  bool starter = false;  // the key held at start: cranks an engine that has stalled (automatic mode does so by itself)

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

// The same controls with each value in its range, NaN replaced by 0, an unknown mode by automatic.
Controls Clamp(const Controls& controls);

}  // namespace rodeira::dynamics

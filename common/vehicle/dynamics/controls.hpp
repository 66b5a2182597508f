// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The controls of a vehicle.

#include <cstdint>

#include "common/core/base/state.hpp"

namespace rodeira::dynamics {

/// What operates clutch and gears. The numbers are on the wire and in recordings; they never change.
enum class GearboxMode : std::uint32_t {
  kAutomatic = 0,  ///< the car: `gear` is the selector (R, N, D), the clutch pedal is ignored
  kManual = 1,     ///< the driver: `gear` is the lever, `clutch` the pedal
};

/// The driver's inputs, constant during one step. Clamp limits values out of their range.
struct Controls {
  double steering_wheel_rad = 0.0;  ///< angle of the steering wheel, positive to the left, 0 straight ahead
  double throttle = 0.0;            ///< 0 released … 1 to the floor
  double brake = 0.0;               ///< 0 released … 1 to the floor
  double clutch = 0.0;              ///< 0 released (engaged) … 1 to the floor (disengaged); manual mode only
  double handbrake = 0.0;           ///< 0 released … 1 fully pulled
  /// -1 reverse, 0 neutral, 1 … n forward. Automatic mode reads the sign only: negative R, zero N, positive D.
  std::int32_t gear = 1;
  GearboxMode gearbox = GearboxMode::kAutomatic;  ///< what operates clutch and gears
  bool starter = false;  ///< the key held at start: cranks a stalled engine (automatic mode cranks by itself)

  /// Writes all values.
  /// @param writer receives the fields
  void Save(base::StateWriter& writer) const;
  /// Reads the values of Save.
  /// @param reader the fields
  void Restore(base::StateReader& reader);
};

/// Limits controls to their ranges.
/// @param controls the controls; any values
/// @return the same controls with each value in its range, NaN replaced by 0, an unknown mode by automatic
Controls Clamp(const Controls& controls);

}  // namespace rodeira::dynamics

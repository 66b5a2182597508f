// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/state.hpp"
#include "common/vehicle/dynamics/controls.hpp"

namespace rodeira::input_devices {

// What a driver asked of the lever during one step.
struct LeverRequests {
  std::uint32_t up = 0;  // presses
  std::uint32_t down = 0;
  std::uint32_t mode = 0;    // presses of "automatic or manual"
  std::int32_t engaged = 0;  // the gear that is in, as the car says it
};

// The lever of a gearbox worked by buttons. Automatic: R, N, D (-1, 0, 1). Manual: R, N, 1 … forward_gears; it begins
// with the gear that is in, so that asking for the manual mode changes none.
class GearSelector {
 public:
  explicit GearSelector(std::int32_t forward_gears, dynamics::GearboxMode mode = dynamics::GearboxMode::kAutomatic)
      : forward_gears_(forward_gears), mode_(mode) {}

  // Once a step. A change of mode comes before the presses; gears beyond the ends are not reached.
  void Step(const LeverRequests& requests);
  // A lever with places of its own: the gear, whatever the mode.
  void Put(std::int32_t gear) { gear_ = gear; }
  // Sets gear and gearbox mode, nothing else.
  void Show(dynamics::Controls& controls) const;
  // The lever and mode that other hands have left; gears that this one does not have: its nearest.
  void InitialiseFrom(const dynamics::Controls& last);

  void Save(base::StateWriter& out) const;
  void Restore(base::StateReader& in);

 private:
  std::int32_t forward_gears_;
  std::int32_t gear_ = 1;
  dynamics::GearboxMode mode_;
};

}  // namespace rodeira::input_devices

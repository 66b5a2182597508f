// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/gear_selector.hpp"

#include <algorithm>

namespace rodeira::input_devices {

using dynamics::GearboxMode;

void GearSelector::Step(const LeverRequests& requests) {
  if (requests.mode % 2 == 1) {
    const bool to_manual = mode_ == GearboxMode::kAutomatic;
    mode_ = to_manual ? GearboxMode::kManual : GearboxMode::kAutomatic;
    if (to_manual && gear_ > 0) gear_ = std::max(requests.engaged, 1);
  }
  const std::int32_t top = mode_ == GearboxMode::kAutomatic ? 1 : forward_gears_;
  const auto requested = static_cast<std::int64_t>(std::min(gear_, top)) + requests.up - requests.down;
  gear_ = static_cast<std::int32_t>(std::clamp<std::int64_t>(requested, -1, top));
}

void GearSelector::Show(dynamics::Controls& controls) const {
  controls.gear = gear_;
  controls.gearbox = mode_;
}

void GearSelector::InitialiseFrom(const dynamics::Controls& last) {
  mode_ = last.gearbox;
  gear_ = std::clamp(last.gear, -1, mode_ == GearboxMode::kAutomatic ? 1 : forward_gears_);
}

void GearSelector::Save(base::StateWriter& out) const {
  out.Put("gear", gear_);
  out.Put("mode", mode_);
}

void GearSelector::Restore(base::StateReader& in) {
  in.Get("gear", gear_);
  in.Get("mode", mode_);
}

}  // namespace rodeira::input_devices

// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/signals.hpp"

namespace rodeira::input_devices {

void SignalSwitch::Press(Indicators side, std::uint32_t presses) {
  if (presses == 0) return;
  const bool was_on = lever_ == side;
  lever_ = was_on == (presses % 2 == 0) ? side : Indicators::kOff;
  in_bend_ = false;
}

Signals SignalSwitch::Step(const SignalRequests& requests, double steering_wheel_rad) {
  Press(Indicators::kLeft, requests.left);
  Press(Indicators::kRight, requests.right);
  if (requests.hazard % 2 == 1) hazard_ = !hazard_;
  headlights_ = static_cast<Headlights>((static_cast<std::uint32_t>(headlights_) + requests.headlights % 3) % 3);
  horn_ = requests.horn;
  if (lever_ != Indicators::kOff) {
    const double into_rad = lever_ == Indicators::kLeft ? steering_wheel_rad : -steering_wheel_rad;
    if (into_rad > kBend_rad) in_bend_ = true;
    if (in_bend_ && into_rad < kBack_rad) {
      lever_ = Indicators::kOff;
      in_bend_ = false;
    }
  }
  return signals();
}

Signals SignalSwitch::signals() const { return {hazard_ ? Indicators::kHazard : lever_, headlights_, horn_}; }

void SignalSwitch::InitialiseFrom(const Signals& last) {
  hazard_ = last.indicators == Indicators::kHazard;
  lever_ = hazard_ ? Indicators::kOff : last.indicators;
  headlights_ = last.headlights;
  horn_ = false;
  in_bend_ = false;
}

void SignalSwitch::Save(base::StateWriter& out) const {
  out.Put("lever", lever_);
  out.Put("headlights", headlights_);
  out.Put("hazard", hazard_);
  out.Put("horn", horn_);
  out.Put("in_bend", in_bend_);
}

void SignalSwitch::Restore(base::StateReader& in) {
  in.Get("lever", lever_);
  in.Get("headlights", headlights_);
  in.Get("hazard", hazard_);
  in.Get("horn", horn_);
  in.Get("in_bend", in_bend_);
}

}  // namespace rodeira::input_devices

// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/pad_driver.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/vehicle/input_devices/turn_wheel.hpp"

namespace rodeira::input_devices {
namespace {

// 0 within the dead zone, from there evenly to 1.
double BeyondDeadZone(double dead_zone, double share) {
  return std::clamp((share - dead_zone) / (1.0 - dead_zone), 0.0, 1.0);
}

}  // namespace

// Down now, and not before: 1.
std::uint32_t PadDriver::Presses(const PadReading& pad, PadButton button) {
  bool& before = down_[static_cast<std::size_t>(button)];
  const bool now = pad.Down(button), pressed = now && !before;
  before = now;
  return pressed ? 1 : 0;
}

dynamics::Controls PadDriver::Step(const PadReading& pad, std::int32_t engaged, double speed_mps, double dt_s) {
  RODEIRA_ASSERT(dt_s > 0.0);
  if (!pad.connected) {
    InitialiseFrom(controls_, signals());
    return controls_;
  }
  const double lock_rad = LockAt(settings_.lock_rad, speed_mps, settings_.half_lock_speed_mps);
  const double share = std::copysign(
      std::pow(BeyondDeadZone(settings_.stick_dead_zone, std::fabs(pad.stick)), settings_.stick_exponent), -pad.stick);
  controls_.steering_wheel_rad = TurnWheel(controls_.steering_wheel_rad, share == 0.0 ? 0.0 : share * lock_rad,
                                           lock_rad / settings_.turn_s, lock_rad / settings_.centre_s, dt_s);
  controls_.throttle = BeyondDeadZone(settings_.trigger_dead_zone, pad.throttle);
  controls_.brake = BeyondDeadZone(settings_.trigger_dead_zone, pad.brake);
  controls_.handbrake = pad.Down(PadButton::kHandbrake) ? 1.0 : 0.0;
  controls_.starter = pad.Down(PadButton::kStarter);
  LeverRequests lever;
  lever.up = Presses(pad, PadButton::kGearUp);
  lever.down = Presses(pad, PadButton::kGearDown);
  lever.mode = Presses(pad, PadButton::kGearboxMode);
  lever.engaged = engaged;
  lever_.Step(lever);
  lever_.Show(controls_);
  SignalRequests lamps;
  lamps.left = Presses(pad, PadButton::kIndicateLeft);
  lamps.right = Presses(pad, PadButton::kIndicateRight);
  lamps.hazard = Presses(pad, PadButton::kHazard);
  lamps.headlights = Presses(pad, PadButton::kHeadlights);
  lamps.horn = pad.Down(PadButton::kHorn);
  (void)signals_.Step(lamps, controls_.steering_wheel_rad);
  return controls_;
}

void PadDriver::InitialiseFrom(const dynamics::Controls& last, const Signals& signals) {
  const double steering_wheel_rad = last.steering_wheel_rad;
  std::fill(std::begin(down_), std::end(down_), false);
  lever_.InitialiseFrom(last);
  signals_.InitialiseFrom(signals);
  controls_ = dynamics::Controls();
  controls_.steering_wheel_rad = steering_wheel_rad;
  lever_.Show(controls_);
}

void PadDriver::Save(base::StateWriter& out) const {
  out.Put("lever", lever_);
  out.Put("signals", signals_);
  for (const bool down : down_) out.Put("down", down);
  out.Put("controls", controls_);
}

void PadDriver::Restore(base::StateReader& in) {
  in.Get("lever", lever_);
  in.Get("signals", signals_);
  for (bool& down : down_) in.Get("down", down);
  in.Get("controls", controls_);
}

}  // namespace rodeira::input_devices

// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/keyboard_driver.hpp"

#include <algorithm>

#include "common/core/base/assert.hpp"
#include "common/vehicle/input_devices/turn_wheel.hpp"

namespace rodeira::input_devices {
namespace {

double MovePedal(double value, bool held, const PedalRates& rates, double dt_s) {
  if (held) return std::min(rates.most, value + dt_s / rates.press_s);
  return std::max(0.0, value - dt_s / rates.release_s);
}

}  // namespace

dynamics::Controls KeyboardDriver::Step(const KeyboardInput& input, double dt_s) {
  RODEIRA_ASSERT(dt_s > 0.0);
  const auto held = [&](Action action) { return input.held[static_cast<std::size_t>(action)]; };
  const double lock = LockAt(settings_.lock_rad, input.speed_mps, settings_.half_lock_speed_mps);
  const double direction = (held(Action::kSteerLeft) ? 1.0 : 0.0) - (held(Action::kSteerRight) ? 1.0 : 0.0);
  wheel_rad_ = TurnWheel(wheel_rad_, direction * lock, lock / settings_.turn_s, lock / settings_.centre_s, dt_s);
  throttle_ = MovePedal(throttle_, held(Action::kThrottle), settings_.throttle, dt_s);
  brake_ = MovePedal(brake_, held(Action::kBrake), settings_.brake, dt_s);
  clutch_ = MovePedal(clutch_, held(Action::kClutch), settings_.clutch, dt_s);
  handbrake_ = held(Action::kHandbrake);
  starter_ = held(Action::kStarter);
  lever_.Step(input.lever);
  (void)signals_.Step(input.signals, wheel_rad_);
  return controls();
}

dynamics::Controls KeyboardDriver::controls() const {
  dynamics::Controls controls;
  controls.steering_wheel_rad = wheel_rad_;
  controls.throttle = throttle_;
  controls.brake = brake_;
  controls.clutch = clutch_;
  controls.handbrake = handbrake_ ? 1.0 : 0.0;
  controls.starter = starter_;
  lever_.Show(controls);
  return controls;
}

void KeyboardDriver::InitialiseFrom(const dynamics::Controls& last, const Signals& signals) {
  wheel_rad_ = last.steering_wheel_rad;
  throttle_ = last.throttle;
  brake_ = last.brake;
  clutch_ = last.clutch;
  handbrake_ = false;
  starter_ = false;
  lever_.InitialiseFrom(last);
  signals_.InitialiseFrom(signals);
}

void KeyboardDriver::Save(base::StateWriter& out) const {
  out.Put("wheel_rad", wheel_rad_);
  out.Put("throttle", throttle_);
  out.Put("brake", brake_);
  out.Put("clutch", clutch_);
  out.Put("handbrake", handbrake_);
  out.Put("starter", starter_);
  out.Put("lever", lever_);
  out.Put("signals", signals_);
}

void KeyboardDriver::Restore(base::StateReader& in) {
  in.Get("wheel_rad", wheel_rad_);
  in.Get("throttle", throttle_);
  in.Get("brake", brake_);
  in.Get("clutch", clutch_);
  in.Get("handbrake", handbrake_);
  in.Get("starter", starter_);
  in.Get("lever", lever_);
  in.Get("signals", signals_);
}

}  // namespace rodeira::input_devices

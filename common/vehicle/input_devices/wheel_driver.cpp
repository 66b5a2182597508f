// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/wheel_driver.hpp"

#include <algorithm>
#include <utility>

#include "common/core/base/assert.hpp"

namespace rodeira::input_devices {

// Empty where the axis is not used, its device does not have it, or it has not moved yet.
std::optional<double> WheelDriver::Raw(std::span<const DeviceReading> devices, WheelAxis axis) {
  const auto& use = settings_.AxisOf(axis);
  if (!use || use->axis >= devices[use->device].axes.size()) return std::nullopt;
  const double raw = devices[use->device].axes[use->axis];
  if (!watches_[static_cast<std::size_t>(axis)].Moved(*use, raw)) return std::nullopt;
  return raw;
}

double WheelDriver::Pedal(std::span<const DeviceReading> devices, WheelAxis axis) {
  const auto raw = Raw(devices, axis);
  return raw ? OneSided(*settings_.AxisOf(axis), *raw) : 0.0;
}

bool WheelDriver::Down(std::span<const DeviceReading> devices, const ButtonUse& use) const {
  const auto& buttons = devices[use.device].buttons;
  return use.button < buttons.size() && buttons[use.button] != 0;
}

bool WheelDriver::Down(std::span<const DeviceReading> devices, WheelButton button) const {
  const auto& use = settings_.buttons[static_cast<std::size_t>(button)];
  return use && Down(devices, *use);
}

// Down now, and not before.
bool WheelDriver::Pressed(std::span<const DeviceReading> devices, WheelButton button) {
  bool& before = down_[static_cast<std::size_t>(button)];
  const bool now = Down(devices, button);
  const bool pressed = now && !before;
  before = now;
  return pressed;
}

void WheelDriver::ReleasePedals() {
  controls_.throttle = 0.0;
  controls_.brake = 0.0;
  controls_.clutch = 0.0;
  controls_.handbrake = 0.0;
  controls_.starter = false;
  for (AxisWatch& watch : watches_) watch.Forget();
}

dynamics::Controls WheelDriver::Step(std::span<const DeviceReading> devices, std::int32_t engaged) {
  RODEIRA_ASSERT(devices.size() == settings_.devices.size());
  if (std::any_of(devices.begin(), devices.end(), [](const DeviceReading& device) { return !device.connected; })) {
    ReleasePedals();
    rim_rad_.reset();
    SignalRequests nothing;
    (void)signals_.Step(nothing, controls_.steering_wheel_rad);  // no hand is on the horn
    return controls_;
  }
  if (const auto raw = Raw(devices, WheelAxis::kSteering)) {
    controls_.steering_wheel_rad = -settings_.lock_rad * TwoSided(*settings_.AxisOf(WheelAxis::kSteering), *raw);
    rim_rad_ = controls_.steering_wheel_rad;
  }
  controls_.throttle = Pedal(devices, WheelAxis::kThrottle);
  controls_.brake = Pedal(devices, WheelAxis::kBrake);
  if (const auto raw = Raw(devices, WheelAxis::kPedals)) {
    const double both = TwoSided(*settings_.AxisOf(WheelAxis::kPedals), *raw);
    controls_.throttle = std::max(both, 0.0);
    controls_.brake = std::max(-both, 0.0);
  }
  controls_.clutch = Down(devices, WheelButton::kClutch) ? 1.0 : Pedal(devices, WheelAxis::kClutch);
  controls_.handbrake = Down(devices, WheelButton::kHandbrake) ? 1.0 : Pedal(devices, WheelAxis::kHandbrake);
  controls_.starter = Down(devices, WheelButton::kStarter);
  StepLever(devices, engaged);
  StepSignals(devices);
  return controls_;
}

// Up and down go on from where the buttons of R, N and D have put it; places of a lever stand above all buttons.
void WheelDriver::StepLever(std::span<const DeviceReading> devices, std::int32_t engaged) {
  LeverRequests requests;
  requests.up = Pressed(devices, WheelButton::kGearUp) ? 1 : 0;
  requests.down = Pressed(devices, WheelButton::kGearDown) ? 1 : 0;
  requests.mode = Pressed(devices, WheelButton::kGearboxMode) ? 1 : 0;
  requests.engaged = engaged;
  lever_.Step(requests);
  for (const auto& [button, gear] :
       {std::pair(WheelButton::kReverse, -1), std::pair(WheelButton::kNeutral, 0), std::pair(WheelButton::kDrive, 1)}) {
    if (Pressed(devices, button)) lever_.Put(gear);
  }
  if (!settings_.lever.empty()) {
    std::int32_t gear = 0;
    for (const auto& [place, button] : settings_.lever) {
      if (Down(devices, button)) gear = place;
    }
    lever_.Put(gear);
  }
  lever_.Show(controls_);
}

void WheelDriver::StepSignals(std::span<const DeviceReading> devices) {
  SignalRequests requests;
  requests.left = Pressed(devices, WheelButton::kIndicateLeft) ? 1 : 0;
  requests.right = Pressed(devices, WheelButton::kIndicateRight) ? 1 : 0;
  requests.hazard = Pressed(devices, WheelButton::kHazard) ? 1 : 0;
  requests.headlights = Pressed(devices, WheelButton::kHeadlights) ? 1 : 0;
  requests.horn = Down(devices, WheelButton::kHorn);
  (void)signals_.Step(requests, controls_.steering_wheel_rad);
}

void WheelDriver::InitialiseFrom(const dynamics::Controls& last, const Signals& signals) {
  ReleasePedals();
  std::fill(std::begin(down_), std::end(down_), false);
  controls_.steering_wheel_rad = last.steering_wheel_rad;
  lever_.InitialiseFrom(last);
  signals_.InitialiseFrom(signals);
  lever_.Show(controls_);
}

void WheelDriver::Save(base::StateWriter& out) const {
  out.Put("lever", lever_);
  out.Put("signals", signals_);
  for (const AxisWatch& watch : watches_) out.Put("axis", watch);
  for (const bool down : down_) out.Put("down", down);
  out.Put("controls", controls_);
}

void WheelDriver::Restore(base::StateReader& in) {
  in.Get("lever", lever_);
  in.Get("signals", signals_);
  for (AxisWatch& watch : watches_) in.Get("axis", watch);
  for (bool& down : down_) in.Get("down", down);
  in.Get("controls", controls_);
}

}  // namespace rodeira::input_devices

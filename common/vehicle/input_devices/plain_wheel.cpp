// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/plain_wheel.hpp"

#include <fmt/format.h>

#include "common/vehicle/input_devices/wheel_names.hpp"

namespace rodeira::input_devices {
namespace {

constexpr double kPedalDeadZone = 0.02;

}  // namespace

std::optional<WheelSettings> PlainWheel(const DeviceUse& device, std::size_t axes, std::size_t buttons) {
  if (axes < 2) return std::nullopt;
  WheelSettings wheel;
  wheel.devices = {device};
  const auto use = [&](WheelAxis what, std::size_t axis) {
    AxisUse& made = wheel.axes[static_cast<std::size_t>(what)].emplace();
    made.axis = axis;
    made.inverted = what != WheelAxis::kSteering;
    made.dead_zone = made.inverted ? kPedalDeadZone : 0.0;
  };
  use(WheelAxis::kSteering, 0);
  if (axes == 2) {
    use(WheelAxis::kPedals, 1);
  } else {
    use(WheelAxis::kThrottle, axes == 3 ? 1 : 2);
    use(WheelAxis::kBrake, axes == 3 ? 2 : 3);
  }
  const std::size_t first = buttons >= 6 ? 4 : 0;
  if (buttons >= 2) {
    wheel.buttons[static_cast<std::size_t>(WheelButton::kGearUp)] = ButtonUse{0, first, ""};
    wheel.buttons[static_cast<std::size_t>(WheelButton::kGearDown)] = ButtonUse{0, first + 1, ""};
  }
  return wheel;
}

std::string AxesText(const WheelSettings& settings) {
  std::string text;
  for (std::size_t i = 0; i < kWheelAxes; ++i) {
    if (settings.axes[i])
      text += text.empty() ? fmt::format("{} on axis {}", kAxisNames[i], settings.axes[i]->axis)
                           : fmt::format(", {} on {}", kAxisNames[i], settings.axes[i]->axis);
  }
  return text;
}

}  // namespace rodeira::input_devices

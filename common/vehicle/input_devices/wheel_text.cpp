// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "common/core/base/constants.hpp"
#include "common/core/base/printable.hpp"
#include "common/core/base/user_folders.hpp"
#include "common/vehicle/input_devices/wheel_names.hpp"
#include "common/vehicle/input_devices/wheel_setup.hpp"

namespace rodeira::input_devices {

namespace {

// As a text of YAML, whatever a device calls itself.
std::string Quoted(const std::string& name) {
  std::string quoted = "'";
  for (const char c : base::Printable(name)) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string WheelText(const WheelSettings& s, const std::string& name) {
  std::string text = "rodeira: wheel/1\nname: " + Quoted(name) + "\ndevices:\n";
  for (const DeviceUse& device : s.devices) text += fmt::format("  {}: \"{}\"\n", device.name, device.guid);
  const auto device = [&](std::size_t place) {
    return s.devices.size() > 1 ? fmt::format("device: {}, ", s.devices[place].name) : std::string();
  };
  for (std::size_t i = 0; i < kWheelAxes; ++i) {
    const auto& axis = s.axes[i];
    if (!axis) continue;
    const bool steering = i == static_cast<std::size_t>(WheelAxis::kSteering),
               two_sided = steering || i == static_cast<std::size_t>(WheelAxis::kPedals);
    text += fmt::format("{}: {{{}axis: {}, min: {}, {}max: {}, inverted: {}, dead_zone: {}, exponent: {}{}}}\n",
                        kAxisNames[i], device(axis->device), axis->axis, axis->min,
                        two_sided ? fmt::format("centre: {}, ", axis->centre) : "", axis->max, axis->inverted,
                        axis->dead_zone, axis->exponent,
                        steering ? fmt::format(", lock_deg: {}", s.lock_rad * 180.0 / base::kPi) : "");
  }
  std::string buttons;
  for (std::size_t i = 0; i < kWheelButtons; ++i) {
    if (s.buttons[i])
      buttons +=
          fmt::format("  {}: {{{}button: {}}}\n", kButtonNames[i], device(s.buttons[i]->device), s.buttons[i]->button);
  }
  if (!buttons.empty()) text += "buttons:\n" + buttons;
  if (!s.lever.empty()) text += "lever:\n";
  for (const auto& [gear, use] : s.lever)
    text += fmt::format("  {}: {{{}button: {}}}\n", gear < 0 ? "reverse" : std::to_string(gear), device(use.device),
                        use.button);
  return text + fmt::format("gears: {}\ngearbox: {}\n", s.gears,
                            s.gearbox == dynamics::GearboxMode::kManual ? "manual" : "automatic");
}

std::filesystem::path WheelFolder() { return base::UserConfigFolder() / "wheels"; }

std::filesystem::path WheelFileOf(const std::string& guid) { return WheelFolder() / (guid + ".yaml"); }

}  // namespace rodeira::input_devices

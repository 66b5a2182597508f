// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "common/core/base/constants.hpp"
#include "common/core/base/suggest.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "common/vehicle/input_devices/wheel_names.hpp"

namespace rodeira::input_devices {
namespace {

constexpr const char* kNoGuid =
    "'{}' is '{}'; a GUID of 32 hexadecimal digits was expected, as `rodeira joysticks` lists them";

std::vector<DeviceUse> ReadDevices(const config::Map& map) {
  std::vector<DeviceUse> devices;
  for (const std::string& name : map.Keys()) {
    std::string guid = map.Text(name);
    std::transform(guid.begin(), guid.end(), guid.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (!IsGuid(guid)) map.Problem(name, fmt::format(kNoGuid, "devices." + name, guid));
    devices.push_back({name, guid, map.Place(name)});
  }
  return devices;
}

// Which of the devices; a single one needs no name.
std::size_t ReadDevice(const config::Map& map, const std::vector<DeviceUse>& devices) {
  if (devices.empty()) map.IgnoreKey("device");  // which is said already
  if (devices.empty() || (devices.size() == 1 && !map.Has("device"))) return 0;
  std::vector<std::string> names;
  for (const DeviceUse& device : devices) names.push_back(device.name);
  const std::string name = map.Text("device");
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    if (map.Has("device"))
      map.Problem("device", "config.unknown_name",
                  fmt::format("there is no device '{}'{}", name, base::DidYouMean(name, names)));
    return 0;
  }
  return static_cast<std::size_t>(found - names.begin());
}

AxisUse ReadAxis(const config::Map& map, const std::vector<DeviceUse>& devices, bool two_sided) {
  constexpr config::Range kRaw{-65536.0, 65535.0};
  AxisUse use;
  use.place = map.Place();
  use.device = ReadDevice(map, devices);
  use.axis = static_cast<std::size_t>(map.Integer("axis", 0, 255));
  use.min = map.Number("min", kRaw, use.min);
  use.max = map.Number("max", kRaw, use.max);
  if (two_sided) use.centre = map.Number("centre", kRaw, use.centre);
  use.dead_zone = map.Number("dead_zone", {0.0, 0.9}, use.dead_zone);
  use.exponent = map.Number("exponent", {0.2, 5.0}, use.exponent);
  use.inverted = map.Flag("inverted", use.inverted);
  if (use.max <= use.min) {
    constexpr const char* kOrder =
        "'max' is {} and 'min' {}; a larger 'max' was expected ('inverted: true' turns an axis round)";
    map.Problem("max", "config.wrong_order", fmt::format(kOrder, use.max, use.min));
  } else if (two_sided && (use.centre <= use.min || use.centre >= use.max)) {
    constexpr const char* kBetween = "'centre' is {}; a number between 'min' ({}) and 'max' ({}) was expected";
    map.Problem("centre", "config.wrong_order", fmt::format(kBetween, use.centre, use.min, use.max));
  }
  return use;
}

ButtonUse ReadButton(const config::Map& map, const std::vector<DeviceUse>& devices) {
  return {ReadDevice(map, devices), static_cast<std::size_t>(map.Integer("button", 0, 255)), map.Place()};
}

void ReadLever(const config::Map& map, WheelSettings& settings) {
  for (const std::string& key : map.Keys()) {
    int gear = 0;
    const auto [end, problem] = std::from_chars(key.data(), key.data() + key.size(), gear);
    if (key == "reverse") {
      gear = -1;
    } else if (problem != std::errc{} || end != key.data() + key.size() || gear < 1 || gear > settings.gears) {
      constexpr const char* kNoPlace = "'{}' is no place of the lever; reverse or a gear from 1 to {} was expected";
      map.Problem(key, fmt::format(kNoPlace, key, settings.gears));
      continue;
    }
    settings.lever[gear] = ReadButton(map.Child(key), settings.devices);
  }
}

void ReadForce(const config::Map& force, WheelSettings& settings) {
  ForceSettings& f = settings.force;
  settings.has_force = force.Flag("on", true);
  settings.force_inverted = force.Flag("inverted", false);
  settings.force_lock_rad =
      force.Number("lock_deg", {10.0, 1800.0}, settings.lock_rad * 180.0 / base::kPi) * base::kPi / 180.0;
  f.device_Nm = force.Number("device_Nm", {0.1, 50.0}, f.device_Nm);
  f.most_Nm = force.Number("most_Nm", {0.0, f.device_Nm}, std::min(f.most_Nm, f.device_Nm));
  f.share = force.Number("share", {0.0, 2.0}, f.share);
  f.friction_Nm = force.Number("friction_Nm", {0.0, 5.0}, f.friction_Nm);
  f.damping_Nmsprad = force.Number("damping_Nmsprad", {0.0, 1.0}, f.damping_Nmsprad);
  f.stop_Nmprad = force.Number("stop_Nmprad", {0.0, 100.0}, f.stop_Nmprad);
  f.road_feel = force.Number("road_feel", {0.0, 5.0}, f.road_feel);
  f.fade_s = force.Number("fade_s", {0.1, 10.0}, f.fade_s);
}

}  // namespace

bool IsGuid(std::string_view text) {
  return text.size() == 32 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
}

WheelSettings ReadWheel(const config::Map& root) {
  WheelSettings s;
  (void)root.Choice("rodeira", {"wheel/1"});
  (void)root.Text("name", "");
  s.gears = static_cast<std::int32_t>(root.Integer("gears", 1, 20, s.gears));
  const bool manual = root.Choice("gearbox", {"automatic", "manual"}, "automatic") == "manual";
  s.gearbox = manual ? dynamics::GearboxMode::kManual : dynamics::GearboxMode::kAutomatic;
  s.devices = ReadDevices(root.Child("devices"));
  if (root.Has("devices") && s.devices.empty())
    root.Problem("devices", "config.too_few", "'devices' names none; at least one device with its GUID was expected");
  const config::Map steering = root.Child("steering");
  s.lock_rad = steering.Number("lock_deg", {10.0, 1800.0}, s.lock_rad * 180.0 / base::kPi) * base::kPi / 180.0;
  s.axes[0] = ReadAxis(steering, s.devices, true);
  for (std::size_t axis = 1; axis < kWheelAxes; ++axis) {
    const bool pedals = axis == static_cast<std::size_t>(WheelAxis::kPedals);
    if (root.Has(kAxisNames[axis])) s.axes[axis] = ReadAxis(root.Child(kAxisNames[axis]), s.devices, pedals);
  }
  if (s.AxisOf(WheelAxis::kPedals) && (s.AxisOf(WheelAxis::kThrottle) || s.AxisOf(WheelAxis::kBrake))) {
    root.Problem("pedals", "config.conflicting_keys",
                 "'pedals' is throttle and brake on one axis; either it or 'throttle' and 'brake' was expected");
  }
  const config::Map buttons = root.OptionalChild("buttons");
  for (std::size_t button = 0; button < kWheelButtons; ++button) {
    if (buttons.Has(kButtonNames[button]))
      s.buttons[button] = ReadButton(buttons.Child(kButtonNames[button]), s.devices);
  }
  ReadLever(root.OptionalChild("lever"), s);
  ReadForce(root.OptionalChild("force"), s);
  return s;
}

std::optional<WheelSettings> PeekWheel(
    const std::filesystem::path& path,
    const std::function<std::optional<std::string>(const std::string&)>& other_guid) {
  auto settings = LoadWheel(path);
  if (!settings) return std::nullopt;
  for (DeviceUse& device : settings.value().devices) {
    if (auto other = other_guid(device.name); other && IsGuid(*other)) device.guid = std::move(*other);
    std::transform(device.guid.begin(), device.guid.end(), device.guid.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  }
  return std::move(settings).value();
}

base::Result<WheelSettings> LoadWheel(const std::filesystem::path& path) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  WheelSettings settings = ReadWheel(file.value().root());
  if (const base::Status status = file.value().Finish(); !status) return status.error();
  return settings;
}

}  // namespace rodeira::input_devices

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "common/core/base/constants.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/config/declared.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "common/vehicle/input_devices/wheel_names.hpp"
#include "common/vehicle/input_devices/wheel_schema.hpp"

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

AxisUse ReadAxis(const config::DeclaredMap& declared, const std::vector<DeviceUse>& devices, bool two_sided) {
  const config::Map& map = declared.map();
  AxisUse use;
  use.place = map.Place();
  use.device = ReadDevice(declared.MapWith("device"), devices);
  use.axis = static_cast<std::size_t>(declared.Integer("axis"));
  use.min = declared.Number("min");
  use.max = declared.Number("max");
  if (two_sided) use.centre = declared.Number("centre");
  use.dead_zone = declared.Number("dead_zone");
  use.exponent = declared.Number("exponent");
  use.inverted = declared.Flag("inverted");
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

ButtonUse ReadButton(const config::DeclaredMap& map, const std::vector<DeviceUse>& devices) {
  return {ReadDevice(map.MapWith("device"), devices), static_cast<std::size_t>(map.Integer("button")),
          map.map().Place()};
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
    settings.lever[gear] = ReadButton({map.Child(key), ButtonKeys()}, settings.devices);
  }
}

void ReadForce(const config::DeclaredMap& force, WheelSettings& settings) {
  ForceSettings& f = settings.force;
  settings.has_force = force.Flag("on");
  settings.force_inverted = force.Flag("inverted");
  settings.force_lock_rad = force.Number("lock_deg", settings.lock_rad * 180.0 / base::kPi) * base::kPi / 180.0;
  f.device_Nm = force.Number("device_Nm");
  f.most_Nm = force.MapWith("most_Nm").Number("most_Nm", {0.0, f.device_Nm}, std::min(f.most_Nm, f.device_Nm));
  f.share = force.Number("share");
  f.friction_Nm = force.Number("friction_Nm");
  f.damping_Nmsprad = force.Number("damping_Nmsprad");
  f.stop_Nmprad = force.Number("stop_Nmprad");
  f.road_feel = force.Number("road_feel");
  f.fade_s = force.Number("fade_s");
}

}  // namespace

bool IsGuid(std::string_view text) {
  return text.size() == 32 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
}

WheelSettings ReadWheel(const config::Map& root) {
  const config::DeclaredMap declared(root, WheelSchema().keys);
  WheelSettings s;
  (void)declared.Word("rodeira");
  (void)declared.Text("name");
  s.gears = static_cast<std::int32_t>(declared.Integer("gears"));
  const bool manual = declared.Word("gearbox") == "manual";
  s.gearbox = manual ? dynamics::GearboxMode::kManual : dynamics::GearboxMode::kAutomatic;
  s.devices = ReadDevices(declared.MapWith("devices").Child("devices"));
  if (root.Has("devices") && s.devices.empty())
    root.Problem("devices", "config.too_few", "'devices' names none; at least one device with its GUID was expected");
  const config::DeclaredMap steering = declared.Child("steering");
  s.lock_rad = steering.Number("lock_deg") * base::kPi / 180.0;
  s.axes[0] = ReadAxis(steering, s.devices, true);
  for (std::size_t axis = 1; axis < kWheelAxes; ++axis) {
    const bool pedals = axis == static_cast<std::size_t>(WheelAxis::kPedals);
    if (root.Has(kAxisNames[axis])) s.axes[axis] = ReadAxis(declared.Child(kAxisNames[axis]), s.devices, pedals);
  }
  if (s.AxisOf(WheelAxis::kPedals) && (s.AxisOf(WheelAxis::kThrottle) || s.AxisOf(WheelAxis::kBrake))) {
    root.Problem("pedals", "config.conflicting_keys",
                 "'pedals' is throttle and brake on one axis; either it or 'throttle' and 'brake' was expected");
  }
  const config::DeclaredMap buttons = declared.Child("buttons");
  for (std::size_t button = 0; button < kWheelButtons; ++button) {
    if (buttons.map().Has(kButtonNames[button]))
      s.buttons[button] = ReadButton(buttons.Child(kButtonNames[button]), s.devices);
  }
  ReadLever(declared.MapWith("lever").OptionalChild("lever"), s);
  ReadForce(declared.Child("force"), s);
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

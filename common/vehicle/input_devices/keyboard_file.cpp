// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "common/core/base/constants.hpp"
#include "common/core/base/suggest.hpp"
#include "common/vehicle/input_devices/keyboard_driver.hpp"

namespace rodeira::input_devices {
namespace {

constexpr std::array<const char*, kActions> kActionKeys{
    "steer_left",    "steer_right",    "throttle",      "brake",      "clutch",
    "handbrake",     "starter",        "gear_up",       "gear_down",  "gearbox_mode",
    "indicate_left", "indicate_right", "hazard_lights", "headlights", "horn"};
constexpr std::array<const char*, kActions> kHelp{"steer left",
                                                  "steer right",
                                                  "throttle",
                                                  "brake",
                                                  "clutch",
                                                  "handbrake",
                                                  "starter",
                                                  "gear up (R N D)",
                                                  "gear down",
                                                  "automatic or manual",
                                                  "indicator left",
                                                  "indicator right",
                                                  "hazard lights",
                                                  "headlights: off, dipped, full",
                                                  "horn"};

// Which keys do what; a key does one thing, and not what the window keeps for itself.
void ReadKeys(const config::Map& map, KeyboardSettings& settings) {
  std::map<Key, std::string> taken;
  for (std::size_t action = 0; action < kActions; ++action) {
    const config::List names = map.OptionalItems(kActionKeys[action]);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string name = names.Text(i);
      const auto key = KeyOf(name);
      if (!key) {
        names.Problem(i, "config.unknown_name",
                      fmt::format("there is no key '{}'{}", name, base::DidYouMean(name, KeyNames())));
      } else if (const WindowKey* window = FindWindowKey(*key)) {
        names.Problem(i, fmt::format("'{}' cannot drive: the window keeps it ({})", name, window->does));
      } else if (const auto other = taken.find(*key); other != taken.end()) {
        constexpr const char* kTaken = "'{}' is taken for '{}' already; a key that does nothing else was expected";
        names.Problem(i, "config.duplicate_name", fmt::format(kTaken, name, other->second));
      } else {
        taken[*key] = kActionKeys[action];
        settings.keys[action].push_back(*key);
      }
    }
  }
  for (const Action needed : {Action::kSteerLeft, Action::kSteerRight, Action::kThrottle, Action::kBrake}) {
    const auto at = static_cast<std::size_t>(needed);
    if (!settings.keys[at].empty() || map.Has(kActionKeys[at])) continue;
    map.Problem(kActionKeys[at], "config.missing_key",
                fmt::format("'keys.{}' is missing; a list of keys was expected", kActionKeys[at]));
  }
}

PedalRates ReadRates(const config::Map& map, PedalRates rates) {
  rates.press_s = map.Number("press_s", {0.01, 10.0}, rates.press_s);
  rates.release_s = map.Number("release_s", {0.01, 10.0}, rates.release_s);
  rates.most = map.Number("most", {0.05, 1.0}, rates.most);
  return rates;
}

}  // namespace

KeyboardSettings ReadKeyboard(const config::Map& root) {
  KeyboardSettings s;
  (void)root.Choice("rodeira", {"keyboard/1"});
  (void)root.Text("name", "");
  const config::Map keys = root.Child("keys");
  if (root.Has("keys")) ReadKeys(keys, s);
  const config::Map steering = root.OptionalChild("steering");
  s.lock_rad = steering.Number("lock_deg", {10.0, 1800.0}, s.lock_rad * 180.0 / base::kPi) * base::kPi / 180.0;
  s.half_lock_speed_mps = steering.Number("half_lock_speed_mps", {0.5, 200.0}, s.half_lock_speed_mps);
  s.turn_s = steering.Number("turn_s", {0.05, 10.0}, s.turn_s);
  s.centre_s = steering.Number("centre_s", {0.05, 10.0}, s.centre_s);
  s.throttle = ReadRates(root.OptionalChild("throttle"), s.throttle);
  s.brake = ReadRates(root.OptionalChild("brake"), s.brake);
  s.clutch = ReadRates(root.OptionalChild("clutch"), s.clutch);
  s.gears = static_cast<std::int32_t>(root.Integer("gears", 1, 20, s.gears));
  const bool manual = root.Choice("gearbox", {"automatic", "manual"}, "automatic") == "manual";
  s.gearbox = manual ? dynamics::GearboxMode::kManual : dynamics::GearboxMode::kAutomatic;
  return s;
}

base::Result<KeyboardSettings> LoadKeyboard(const std::filesystem::path& path) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  KeyboardSettings settings = ReadKeyboard(file.value().root());
  if (const base::Status status = file.value().Finish(); !status) return status.error();
  return settings;
}

std::string KeyboardHelp(const KeyboardSettings& settings) {
  std::string text;
  for (std::size_t action = 0; action < kActions; ++action) {
    std::string keys;
    for (const Key key : settings.keys[action]) keys += (keys.empty() ? "" : ", ") + NameOf(key);
    if (!keys.empty()) text += fmt::format("{}{}  {}", text.empty() ? "" : "\n", keys, kHelp[action]);
  }
  return text;
}

}  // namespace rodeira::input_devices

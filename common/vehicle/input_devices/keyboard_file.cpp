// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "common/core/base/constants.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/config/declared.hpp"
#include "common/vehicle/input_devices/keyboard_driver.hpp"
#include "common/vehicle/input_devices/keyboard_schema.hpp"

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

// A key of each action for generated files.
constexpr std::array<const char*, kActions> kSampleKeys{"left", "right", "up",    "down",   "c",     "b", "i", "e",
                                                        "q",    "m",     "comma", "period", "slash", "l", "n"};

std::vector<config::Key> RateKeys(const PedalRates& usual) {
  return {config::NumberKey("press_s", {0.01, 10.0}, usual.press_s, "Time of pressing the pedal fully."),
          config::NumberKey("release_s", {0.01, 10.0}, usual.release_s, "Time of releasing it."),
          config::NumberKey("most", {0.05, 1.0}, usual.most, "How far a held key presses the pedal.")};
}

config::Schema MakeKeyboardSchema() {
  const KeyboardSettings usual;
  std::vector<config::Key> actions;
  for (std::size_t action = 0; action < kActions; ++action) {
    actions.push_back(config::ListKey(kActionKeys[action], config::TextItem(kSampleKeys[action]),
                                      fmt::format("Keys: {}.", kHelp[action])));
    if (action < 4) actions.back() = config::Required(actions.back());
  }
  return {"keyboard", "keyboard/1", "Keys that drive, for an input with 'source: keyboard'.",
          config::FileKeys(
              "keyboard/1",
              {config::TextKey("name", "", "Name, for the reader."),
               config::Required(config::MappingKey("keys", std::move(actions), "The keys of each action.")),
               config::MappingKey(
                   "steering",
                   {config::NumberKey("lock_deg", {10.0, 1800.0}, usual.lock_rad * 180.0 / base::kPi,
                                      "Angle of the steering wheel at the end, at rest."),
                    config::NumberKey("half_lock_speed_mps", {0.5, 200.0}, usual.half_lock_speed_mps,
                                      "Speed at which half of that angle is left."),
                    config::NumberKey("turn_s", {0.05, 10.0}, usual.turn_s, "Time from straight ahead to the end."),
                    config::NumberKey("centre_s", {0.05, 10.0}, usual.centre_s, "Time back.")},
                   "The steering wheel."),
               config::MappingKey("throttle", RateKeys(usual.throttle), "The throttle."),
               config::MappingKey("brake", RateKeys(usual.brake), "The brake."),
               config::MappingKey("clutch", RateKeys(usual.clutch), "The clutch."),
               config::IntegerKey("gears", 1, 20, usual.gears, "Forward gears of the manual mode."),
               config::WordKey("gearbox", {"automatic", "manual"}, "automatic", "Mode at the start.")})};
}

// Which keys do what; a key does one thing, and not what the window keeps for itself.
void ReadKeys(const config::DeclaredMap& declared, KeyboardSettings& settings) {
  const config::Map& map = declared.map();
  std::map<Key, std::string> taken;
  for (std::size_t action = 0; action < kActions; ++action) {
    const config::List names = declared.MapWith(kActionKeys[action]).OptionalItems(kActionKeys[action]);
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

PedalRates ReadRates(const config::DeclaredMap& map) {
  return {map.Number("press_s"), map.Number("release_s"), map.Number("most")};
}

}  // namespace

const config::Schema& KeyboardSchema() {
  static const config::Schema schema = MakeKeyboardSchema();
  return schema;
}

KeyboardSettings ReadKeyboard(const config::Map& root) {
  const config::DeclaredMap declared(root, KeyboardSchema().keys);
  KeyboardSettings s;
  (void)declared.Word("rodeira");
  (void)declared.Text("name");
  const config::DeclaredMap keys = declared.Child("keys");
  if (root.Has("keys")) ReadKeys(keys, s);
  const config::DeclaredMap steering = declared.Child("steering");
  s.lock_rad = steering.Number("lock_deg") * base::kPi / 180.0;
  s.half_lock_speed_mps = steering.Number("half_lock_speed_mps");
  s.turn_s = steering.Number("turn_s");
  s.centre_s = steering.Number("centre_s");
  s.throttle = ReadRates(declared.Child("throttle"));
  s.brake = ReadRates(declared.Child("brake"));
  s.clutch = ReadRates(declared.Child("clutch"));
  s.gears = static_cast<std::int32_t>(declared.Integer("gears"));
  const bool manual = declared.Word("gearbox") == "manual";
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

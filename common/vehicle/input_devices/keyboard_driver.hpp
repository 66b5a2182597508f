// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/core/config/config.hpp"
#include "common/vehicle/dynamics/controls.hpp"
#include "common/vehicle/input_devices/gear_selector.hpp"
#include "common/vehicle/input_devices/key_names.hpp"
#include "common/vehicle/input_devices/signals.hpp"

namespace rodeira::input_devices {

enum class Action : std::size_t {
  kSteerLeft,
  kSteerRight,
  kThrottle,
  kBrake,
  kClutch,
  kHandbrake,
  kStarter,
  kGearUp,
  kGearDown,
  kGearboxMode,
  kIndicateLeft,
  kIndicateRight,
  kHazard,
  kHeadlights,
  kHorn
};
inline constexpr std::size_t kActions = 15;

// From nothing to the floor, and back.
struct PedalRates {
  double press_s = 0.4;
  double release_s = 0.2;
  double most = 1.0;  // how far a held key presses the pedal
};

// `rodeira: keyboard/1` (docs/reference/driver-files.md). The values are choices of this project.
struct KeyboardSettings {
  std::vector<Key> keys[kActions];
  double lock_rad = 7.85;            // of the steering wheel, at rest
  double half_lock_speed_mps = 6.5;  // where only half of it is left
  double turn_s = 1.1;               // from straight ahead to the lock of that speed
  double centre_s = 0.3;             // from there back: quick, or a person steers into a wheel that is still on its way
  PedalRates throttle{0.5, 0.2, 1.0};
  PedalRates brake{0.4, 0.15, 0.85};
  PedalRates clutch{0.1, 0.4, 1.0};
  std::int32_t gears = 5;
  dynamics::GearboxMode gearbox = dynamics::GearboxMode::kAutomatic;

  // Any one of them acts; empty: no key does.
  const std::vector<Key>& KeysOf(Action action) const { return keys[static_cast<std::size_t>(action)]; }
};

// Problems stay in the file's collection.
KeyboardSettings ReadKeyboard(const config::Map& root);
// Wrong input, with place and reason, where the file is missing or faulty.
base::Result<KeyboardSettings> LoadKeyboard(const std::filesystem::path& path);
// A line an action, for people: "up, w  throttle".
std::string KeyboardHelp(const KeyboardSettings& settings);

// What the driver does during one step.
struct KeyboardInput {
  bool held[kActions] = {};
  LeverRequests lever;
  SignalRequests signals;
  double speed_mps = 0.0;  // of the car, forward
};

// Drives with keys that are either down or up. Steering: a held key turns the wheel towards the lock of the present
// speed,
//   lock(v) = lock / (1 + (v / half_lock_speed)²),
// which is about the same lateral acceleration at all speeds from walking pace on, at the rate lock(v) / turn_s; let
// go, the wheel comes back at lock(v) / centre_s and stands at exactly 0. So the same tap is a smaller correction the
// faster the car goes. Pedals go down and up at constant rates.
class KeyboardDriver {
 public:
  explicit KeyboardDriver(const KeyboardSettings& settings)
      : settings_(settings), lever_(settings.gears, settings.gearbox) {}

  // The controls dt_s (over 0) later.
  dynamics::Controls Step(const KeyboardInput& input, double dt_s);
  // The controls as they are.
  dynamics::Controls controls() const;
  Signals signals() const { return signals_.signals(); }
  // Goes on from where others have left hands, feet and levers.
  void InitialiseFrom(const dynamics::Controls& last, const Signals& signals = {});

  void Save(base::StateWriter& out) const;
  void Restore(base::StateReader& in);

 private:
  KeyboardSettings settings_;
  GearSelector lever_;
  SignalSwitch signals_;
  double wheel_rad_ = 0.0;
  double throttle_ = 0.0;
  double brake_ = 0.0;
  double clutch_ = 0.0;
  bool handbrake_ = false;
  bool starter_ = false;
};

}  // namespace rodeira::input_devices

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/core/config/config.hpp"
#include "common/vehicle/dynamics/controls.hpp"
#include "common/vehicle/input_devices/axis.hpp"
#include "common/vehicle/input_devices/force_feedback.hpp"
#include "common/vehicle/input_devices/gear_selector.hpp"
#include "common/vehicle/input_devices/signals.hpp"

namespace rodeira::input_devices {

// A button of a device of the file; `place` is its "file:line".
struct ButtonUse {
  std::size_t device = 0;
  std::size_t button = 0;
  std::string place;
};

// A device is known by its GUID (32 hexadecimal digits: kind of connection, maker, product), never by a number that
// changes with the order of plugging in.
struct DeviceUse {
  std::string name;  // in this file
  std::string guid;
  std::string place;
};

enum class WheelAxis : std::size_t { kSteering, kThrottle, kBrake, kClutch, kHandbrake, kPedals };
inline constexpr std::size_t kWheelAxes = 6;
// kCamera is the window's and kPause the operator's: they do nothing to the controls.
enum class WheelButton : std::size_t {
  kGearUp,
  kGearDown,
  kGearboxMode,
  kClutch,
  kHandbrake,
  kStarter,
  kIndicateLeft,
  kIndicateRight,
  kHazard,
  kHeadlights,
  kHorn,
  kReverse,
  kNeutral,
  kDrive,
  kCamera,
  kPause
};
inline constexpr std::size_t kWheelButtons = 16;

// `rodeira: wheel/1` (docs/reference/driver-files.md).
struct WheelSettings {
  std::vector<DeviceUse> devices;
  std::optional<AxisUse> axes[kWheelAxes];  // kPedals: throttle on its positive side, brake on the other
  std::optional<ButtonUse> buttons[kWheelButtons];
  std::map<std::int32_t, ButtonUse> lever;  // places of a lever: gear → button that is down there; none down is neutral
  double lock_rad = 7.85;                   // of the car's steering wheel where the axis is at its end
  std::int32_t gears = 5;
  dynamics::GearboxMode gearbox = dynamics::GearboxMode::kAutomatic;
  ForceSettings force;           // of the steering's device, where it has motors
  double force_lock_rad = 7.85;  // where they hold the wheel: at the car's own lock
  bool has_force = true;         // false: its motors rest
  bool force_inverted = false;

  // Nothing: the file names no axis for it.
  const std::optional<AxisUse>& AxisOf(WheelAxis axis) const { return axes[static_cast<std::size_t>(axis)]; }
};

// Problems stay in the file's collection.
WheelSettings ReadWheel(const config::Map& root);
// Wrong input, with place and reason, where the file is missing or faulty.
base::Result<WheelSettings> LoadWheel(const std::filesystem::path& path);
// 32 hexadecimal digits.
bool IsGuid(std::string_view text);
// The wheel of an input node that names this file. The launch file may say other GUIDs: `other_guid`, by a
// device's name, says which. Nothing where the file cannot be read: that is the input's to say.
std::optional<WheelSettings> PeekWheel(const std::filesystem::path& path,
                                       const std::function<std::optional<std::string>(const std::string&)>& other_guid);

// What one device says now.
struct DeviceReading {
  bool connected = false;
  std::vector<double> axes;
  std::vector<std::uint8_t> buttons;
};

// Steering wheel, pedals and lever of flesh and plastic. Where one of its devices is unplugged the pedals are released,
// the steering stays as it is, and the run goes on; plugged in again, each of its axes counts from its first move on.
class WheelDriver {
 public:
  explicit WheelDriver(const WheelSettings& settings) : settings_(settings), lever_(settings.gears, settings.gearbox) {}

  // From the readings of all devices, in the settings' order; `engaged` is the gear that is in. Steering is positive to
  // the left, a device's axis to the right.
  // Returns the car's controls of this step, which controls() says again.
  dynamics::Controls Step(std::span<const DeviceReading> devices, std::int32_t engaged);
  const dynamics::Controls& controls() const { return controls_; }
  Signals signals() const { return signals_.signals(); }
  // The angle of the rim itself, from its axis, beyond the car's lock too, positive to the left; nothing before it has
  // moved.
  std::optional<double> rim_rad() const { return rim_rad_; }
  // Goes on from where others have left steering and lever: the steering stays there until the wheel is moved. Pedals
  // are released.
  void InitialiseFrom(const dynamics::Controls& last, const Signals& signals = {});

  void Save(base::StateWriter& out) const;
  void Restore(base::StateReader& in);

 private:
  std::optional<double> Raw(std::span<const DeviceReading> devices, WheelAxis axis);
  double Pedal(std::span<const DeviceReading> devices, WheelAxis axis);
  bool Down(std::span<const DeviceReading> devices, const ButtonUse& use) const;
  bool Down(std::span<const DeviceReading> devices, WheelButton button) const;
  bool Pressed(std::span<const DeviceReading> devices, WheelButton button);
  void ReleasePedals();
  void StepLever(std::span<const DeviceReading> devices, std::int32_t engaged);
  void StepSignals(std::span<const DeviceReading> devices);

  WheelSettings settings_;
  GearSelector lever_;
  SignalSwitch signals_;
  AxisWatch watches_[kWheelAxes];
  bool down_[kWheelButtons] = {};
  dynamics::Controls controls_;
  std::optional<double> rim_rad_;  // no state: only the hands feel it
};

}  // namespace rodeira::input_devices

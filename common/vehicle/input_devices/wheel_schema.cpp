// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/wheel_schema.hpp"

#include "common/core/base/constants.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "common/vehicle/input_devices/wheel_names.hpp"

namespace rodeira::input_devices {
namespace {

using config::FlagKey;
using config::MappingKey;
using config::NumberKey;

config::Key DeviceKey() {
  return config::ComputedTextKey("device", "the only one", "a", "Name of the device, one of `devices`.");
}

std::vector<config::Key> MakeAxisKeys(bool two_sided) {
  constexpr config::Range kRaw{-65536.0, 65535.0};
  const AxisUse usual;
  std::vector<config::Key> keys{
      DeviceKey(), config::RequiredIntegerKey("axis", 0, 255, "Number of the axis, from 0."),
      NumberKey("min", kRaw, usual.min, "Raw value at the one end; of a pedal: released."),
      NumberKey("max", kRaw, usual.max, "Raw value at the other end, above `min`; of a pedal: pressed.")};
  if (two_sided) keys.push_back(NumberKey("centre", kRaw, usual.centre, "Raw value at rest, between both ends."));
  keys.push_back(
      NumberKey("dead_zone", {0.0, 0.9}, usual.dead_zone, "Share of the way next to the rest without effect."));
  keys.push_back(NumberKey("exponent", {0.2, 5.0}, usual.exponent, "Above 1: finer next to the rest."));
  keys.push_back(FlagKey("inverted", usual.inverted, "The axis counts in the other direction."));
  return keys;
}

config::Schema MakeWheelSchema() {
  const WheelSettings usual;
  std::vector<config::Key> keys{config::TextKey("name", "", "Name, for the reader."),
                                config::IntegerKey("gears", 1, 20, usual.gears, "Forward gears of the manual mode."),
                                config::WordKey("gearbox", {"automatic", "manual"}, "automatic", "Mode at the start."),
                                config::Required(config::NamedValueKey(
                                    "devices", config::RequiredTextKey("", "030000006d0400004fc2000011010000", ""),
                                    "GUID of the device: 32 hexadecimal digits, from `rodeira joysticks`.")),
                                config::Required(MappingKey("steering", SteeringKeys(), "The steering wheel."))};
  for (std::size_t axis = 1; axis < kWheelAxes; ++axis) {
    const bool pedals = axis == static_cast<std::size_t>(WheelAxis::kPedals);
    config::Key key =
        MappingKey(kAxisNames[axis], AxisKeys(pedals),
                   pedals ? "Throttle above `centre` and brake below, instead of both." : "A pedal or lever.");
    keys.push_back(axis == 1 ? key : config::Summarised(pedals ? "as `steering`" : "as `throttle`", std::move(key)));
  }
  std::vector<config::Key> buttons;
  for (const char* name : kButtonNames) {
    config::Key button = MappingKey(name, ButtonKeys(), "A button.");
    buttons.push_back(buttons.empty() ? button : config::Summarised("as `gear_up`", std::move(button)));
  }
  keys.push_back(MappingKey("buttons", std::move(buttons), "Buttons."));
  keys.push_back(config::NamedKey("lever", ButtonKeys(), "Gears of a lever: reverse, 1, 2 and so on."));
  keys.back().sample = "reverse";
  keys.push_back(MappingKey("force", ForceKeys(), "Motors of the wheel."));
  return {"wheel", "wheel/1", "Axes and buttons of wheel and pedals, for an input with 'source: joystick'.",
          config::FileKeys("wheel/1", std::move(keys))};
}

}  // namespace

const std::vector<config::Key>& AxisKeys(bool two_sided) {
  static const std::vector<config::Key> one = MakeAxisKeys(false), two = MakeAxisKeys(true);
  return two_sided ? two : one;
}

const std::vector<config::Key>& SteeringKeys() {
  static const std::vector<config::Key> keys = [] {
    std::vector<config::Key> all = MakeAxisKeys(true);
    all.push_back(NumberKey("lock_deg", {10.0, 1800.0}, WheelSettings().lock_rad * 180.0 / base::kPi,
                            "Angle of the car's steering wheel at the end of the axis."));
    return all;
  }();
  return keys;
}

const std::vector<config::Key>& ButtonKeys() {
  static const std::vector<config::Key> keys{
      DeviceKey(), config::RequiredIntegerKey("button", 0, 255, "Number of the button, from 0.")};
  return keys;
}

const std::vector<config::Key>& ForceKeys() {
  static const ForceSettings f;
  static const std::vector<config::Key> keys{
      FlagKey("on", true, "The motors are used."),
      FlagKey("inverted", false, "The motors turn in the other direction."),
      config::ComputedNumberKey("lock_deg", {10.0, 1800.0}, "that of the steering",
                                "Angle at which the motors hold the wheel."),
      NumberKey("device_Nm", {0.1, 50.0}, f.device_Nm, "Largest torque of the device."),
      config::ComputedNumberKey("most_Nm", {0.0, 50.0}, "2.2, or `device_Nm` if less",
                                "Largest torque that is used; not over `device_Nm`."),
      NumberKey("share", {0.0, 2.0}, f.share, "Share of the torque at the car's steering wheel."),
      NumberKey("friction_Nm", {0.0, 5.0}, f.friction_Nm, "Friction."),
      NumberKey("damping_Nmsprad", {0.0, 1.0}, f.damping_Nmsprad, "Damping."),
      NumberKey("stop_Nmprad", {0.0, 100.0}, f.stop_Nmprad, "Stiffness beyond `lock_deg`."),
      NumberKey("road_feel", {0.0, 5.0}, f.road_feel, "Factor of T_road."),
      NumberKey("fade_s", {0.1, 10.0}, f.fade_s, "Time of the fade-in.")};
  return keys;
}

const config::Schema& WheelSchema() {
  static const config::Schema schema = MakeWheelSchema();
  return schema;
}

}  // namespace rodeira::input_devices

// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/joystick_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <utility>

#include "common/core/base/log.hpp"
#include "common/core/base/suggest.hpp"
#include "common/vehicle/input_devices/force_device.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "nodes/input/car_seen.hpp"
#include "nodes/input/found_source.hpp"

namespace rodeira::nodes {
namespace {

class JoystickSource final : public Source {
 public:
  JoystickSource(std::string node, const input_devices::WheelSettings& settings,
                 std::unique_ptr<input_devices::Joysticks> joysticks, MotorOpener motor)
      : node_(std::move(node)),
        settings_(settings),
        driver_(settings),
        joysticks_(std::move(joysticks)),
        there_(settings.devices.size(), true),
        motor_(std::move(motor)),
        force_(settings.force, nullptr) {
    if (motor_ == nullptr)
      motor_ = [this](std::size_t place, bool inverted) { return joysticks_->OpenMotor(place, inverted); };
  }

  dynamics::Controls First() override { return driver_.controls(); }

  base::Result<dynamics::Controls> Step(const lockstep::StepInfo&, std::int64_t,
                                        const lockstep::Inbox& inbox) override {
    const auto car = SeeCar(inbox);
    if (!car) return car.error();
    joysticks_->Update();
    readings_.clear();
    for (std::size_t place = 0; place < settings_.devices.size(); ++place) {
      readings_.push_back(joysticks_->reading(place));
      Tell(place, readings_.back().connected);
    }
    const dynamics::Controls controls = driver_.Step(readings_, car.value().gear);
    Feel(car.value());
    return controls;
  }

  input_devices::Signals signals() const override { return driver_.signals(); }
  bool runs_inline() const override { return false; }  // SDL must be called by one thread
  void Save(base::StateWriter& out) const override { out.Put("wheel", driver_); }
  void Restore(base::StateReader& in) override { in.Get("wheel", driver_); }
  void InitialiseFrom(const dynamics::Controls& last, const input_devices::Signals& signals) override {
    driver_.InitialiseFrom(last, signals);
  }

 private:
  // What the road gives back, to the hands: no part of the run. A wheel that is back has its motor anew.
  void Feel(const CarSeen& car) {
    if (!settings_.has_force) return;
    const std::size_t wheel = settings_.AxisOf(input_devices::WheelAxis::kSteering)->device;
    const std::uint64_t connection = joysticks_->connection(wheel);
    if (connection != felt_) force_.Change(connection == 0 ? nullptr : motor_(wheel, settings_.force_inverted));
    felt_ = connection;
    if (!driver_.rim_rad()) return;
    const double now_s = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    force_.Tell({*driver_.rim_rad(), settings_.force_lock_rad, car.steering_torque_Nm, car.front_load_difference_N},
                now_s);
  }

  // To the person, once for each time.
  void Tell(std::size_t place, bool there) {
    if (there_[place] == there) return;
    there_[place] = there;
    base::Log(there ? base::LogLevel::kInfo : base::LogLevel::kWarning, node_,
              fmt::format("{} '{}' ({}) {}", settings_.devices[place].name, joysticks_->name(place),
                          settings_.devices[place].guid,
                          there ? "is there again" : "was unplugged: pedals released, steering held"));
  }

  std::string node_;
  input_devices::WheelSettings settings_;
  input_devices::WheelDriver driver_;
  std::unique_ptr<input_devices::Joysticks> joysticks_;
  std::vector<bool> there_;
  MotorOpener motor_;
  std::uint64_t felt_ = 0;  // the connection of the wheel with that motor
  std::vector<input_devices::DeviceReading> readings_;
  input_devices::ForceDriver force_;  // before its joystick in dying
};

// GUIDs of the launch file stand above those of the wheel file: the same file then serves several seats.
void ReplaceGuids(const config::Map& config, input_devices::WheelSettings& settings) {
  const config::Map devices = config.OptionalChild("devices");
  std::vector<std::string> names;
  for (const input_devices::DeviceUse& device : settings.devices) names.push_back(device.name);
  for (const std::string& name : devices.Keys()) {
    std::string guid = devices.Text(name);
    std::transform(guid.begin(), guid.end(), guid.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      devices.Problem(name, "config.unknown_name",
                      fmt::format("the wheel file has no device '{}'{}", name, base::DidYouMean(name, names)));
    } else if (!input_devices::IsGuid(guid)) {
      devices.Problem(
          name,
          fmt::format("'{}' is '{}'; a GUID of 32 hexadecimal digits was expected, as `rodeira joysticks` lists them",
                      name, guid));
    } else {
      auto& device = settings.devices[static_cast<std::size_t>(found - names.begin())];
      device.guid = guid;
      device.place = devices.Place(name);
    }
  }
}

// Everything that the file names is there, now.
base::Status CheckDevices(const input_devices::WheelSettings& settings, const input_devices::Joysticks& joysticks) {
  for (std::size_t place = 0; place < settings.devices.size(); ++place) {
    const input_devices::DeviceUse& device = settings.devices[place];
    if (joysticks.reading(place).connected) continue;
    return base::WrongInput("device.not_found",
                            fmt::format("device '{}' with GUID {} is not there; {}", device.name, device.guid,
                                        input_devices::ListJoysticks(joysticks.Connected())),
                            device.place);
  }
  const auto check = [&](std::size_t place, std::size_t number, std::size_t count, const char* kind,
                         const std::string& where) -> base::Status {
    if (number < count) return {};
    return base::WrongInput("device.no_such_axis",
                            fmt::format("{} {} of device '{}' was asked for; '{}' has {} (the first is 0)", kind,
                                        number, settings.devices[place].name, joysticks.name(place), count),
                            where);
  };
  for (const auto& axis : settings.axes) {
    if (!axis) continue;
    if (auto status = check(axis->device, axis->axis, joysticks.reading(axis->device).axes.size(), "axis", axis->place);
        !status)
      return status;
  }
  std::vector<input_devices::ButtonUse> buttons;
  for (const auto& button : settings.buttons) {
    if (button) buttons.push_back(*button);
  }
  for (const auto& [gear, button] : settings.lever) buttons.push_back(button);
  for (const input_devices::ButtonUse& use : buttons) {
    if (auto status = check(use.device, use.button, joysticks.reading(use.device).buttons.size(), "button", use.place);
        !status)
      return status;
  }
  return {};
}

}  // namespace

base::Result<std::unique_ptr<Source>> OpenWheel(const input_devices::WheelSettings& settings, const std::string& node,
                                                MotorOpener motor) {
  auto joysticks = input_devices::Joysticks::Start();
  if (!joysticks) return joysticks.error();
  std::vector<std::string> guids;
  for (const input_devices::DeviceUse& device : settings.devices) guids.push_back(device.guid);
  joysticks.value()->Use(guids);
  if (auto status = CheckDevices(settings, *joysticks.value()); !status) return status.error();
  return std::unique_ptr<Source>(
      std::make_unique<JoystickSource>(node, settings, std::move(joysticks).value(), std::move(motor)));
}

base::Result<std::unique_ptr<Source>> OpenWheelFile(const std::filesystem::path& file, const config::Map& config,
                                                    const std::string& node) {
  auto settings = input_devices::LoadWheel(file);
  if (!settings) return settings.error();
  ReplaceGuids(config, settings.value());
  return OpenWheel(settings.value(), node);
}

base::Result<std::unique_ptr<Source>> MakeJoystickSource(const config::Map& config, launch::NodeContext& context) {
  const auto file = config.OptionalPath("wheel");
  if (!file) return MakeFoundSource(config, context);
  config.IgnoreKey("devices");
  config.IgnoreKey("keyboard");  // where no wheel is named
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  auto source = OpenWheelFile(*file, config, context.spec().name);
  if (auto status = context.launch().file().Finish(); !status) return status.error();  // GUIDs that it says
  return source;
}

}  // namespace rodeira::nodes

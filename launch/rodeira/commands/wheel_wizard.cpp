// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/wheel_wizard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/base/constants.hpp"
#include "common/core/base/files.hpp"

namespace rodeira::cli {
namespace {

std::vector<input_devices::DeviceUse> UsesOf(const std::vector<input_devices::JoystickInfo>& connected) {
  std::vector<input_devices::DeviceUse> uses;
  for (const input_devices::JoystickInfo& info : connected)
    uses.push_back({fmt::format("device{}", uses.size() + 1), info.guid, ""});
  return uses;
}

}  // namespace

base::Result<std::unique_ptr<WheelWizard>> WheelWizard::Begin() {
  auto joysticks = input_devices::Joysticks::Start();
  if (!joysticks) return joysticks.error();
  joysticks.value()->Update();
  auto connected = joysticks.value()->Connected();
  if (connected.empty())
    return base::WrongInput("device.not_found",
                            "no wheel is connected, or none that you may read (`rodeira doctor` says which)");
  return std::unique_ptr<WheelWizard>(new WheelWizard(std::move(joysticks).value(), std::move(connected)));
}

WheelWizard::WheelWizard(std::unique_ptr<input_devices::Joysticks> joysticks,
                         std::vector<input_devices::JoystickInfo> connected)
    : joysticks_(std::move(joysticks)),
      connected_(std::move(connected)),
      setup_(UsesOf(connected_), input_devices::WheelSettings().lock_rad),
      readings_(connected_.size()) {
  std::vector<std::string> guids;
  for (const input_devices::JoystickInfo& info : connected_) guids.push_back(info.guid);
  joysticks_->Use(guids);
}

base::Status WheelWizard::Step(double dt_s) {
  joysticks_->Update();
  for (std::size_t place = 0; place < readings_.size(); ++place) readings_[place] = joysticks_->reading(place);
  if (std::none_of(readings_.begin(), readings_.end(),
                   [](const input_devices::DeviceReading& device) { return device.connected; })) {
    return base::Failed("device.unplugged", "the wheel was unplugged; nothing was written");
  }
  const auto before = setup_.stage();
  setup_.Step(readings_, dt_s);
  waited_s_ += dt_s;
  if (setup_.stage() != before) {
    waited_s_ = 0.0;
    ++number_;
  }
  if (waited_s_ > kPatience_s)
    return base::Failed("device.no_answer", fmt::format("no input for {:.0f} s; nothing was written", kPatience_s));
  return {};
}

base::Result<std::filesystem::path> WheelWizard::Write(const std::optional<std::filesystem::path>& out,
                                                       double lock_deg) const {
  input_devices::WheelSettings settings = setup_.settings();
  settings.lock_rad = lock_deg * base::kPi / 180.0;
  const std::string& guid = settings.devices[settings.AxisOf(input_devices::WheelAxis::kSteering)->device].guid;
  const auto wheel = std::find_if(connected_.begin(), connected_.end(),
                                  [&](const input_devices::JoystickInfo& info) { return info.guid == guid; });
  const std::filesystem::path file = out.value_or(input_devices::WheelFileOf(guid));
  std::error_code problem;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), problem);
  if (const auto written = base::WriteWhole(file, input_devices::WheelText(settings, wheel->name)); !written)
    return written.error();
  return file;
}

}  // namespace rodeira::cli

// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/pause_buttons.hpp"

#include <optional>
#include <string>
#include <utility>

#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "common/vehicle/input_devices/wheel_setup.hpp"

namespace rodeira::cli {
namespace {

bool NamesWheel(const launch::LaunchNode& node) {
  const auto named = node.config->Peek({"config", "wheel"});
  return named && *named != "~";
}

// As the input finds its own.
std::optional<input_devices::WheelSettings> WheelOf(const launch::Launch& launch, const launch::LaunchNode& node,
                                                    input_devices::Joysticks& joysticks) {
  std::filesystem::path file;
  if (NamesWheel(node)) {
    file = (launch.path().parent_path() / *node.config->Peek({"config", "wheel"})).lexically_normal();
  } else {
    for (const input_devices::JoystickInfo& info : joysticks.Connected()) {
      if (const auto own = input_devices::WheelFileOf(info.guid); file.empty() && std::filesystem::exists(own))
        file = own;
    }
  }
  return input_devices::PeekWheel(file, [&](const std::string& device) {
    return node.config->Peek({"config", "devices", device});
  });
}

}  // namespace

std::unique_ptr<PauseButtons> PauseButtons::Open(const launch::Launch& launch) {
  auto made = std::make_unique<PauseButtons>();
  std::vector<std::string> guids;
  for (const launch::LaunchNode& node : launch.nodes()) {
    const auto source = node.kind->name == "input" ? node.config->Peek({"config", "source"}) : std::nullopt;
    if (source == "gamepad" && !made->TakePad()) return nullptr;
    if (source != "joystick") continue;
    if (made->joysticks_ == nullptr) {
      auto started = input_devices::Joysticks::Start();
      if (!started) return nullptr;
      made->joysticks_ = std::move(started).value();
      made->joysticks_->Update();
    }
    const auto wheel = WheelOf(launch, node, *made->joysticks_);
    if (!wheel && !NamesWheel(node) && !made->TakePad()) return nullptr;  // as the input goes on without one
    const auto& use = wheel ? wheel->buttons[static_cast<std::size_t>(input_devices::WheelButton::kPause)]
                            : std::optional<input_devices::ButtonUse>();
    if (!use) continue;
    made->buttons_.push_back({guids.size(), use->button, true});
    guids.push_back(wheel->devices[use->device].guid);
  }
  if (guids.empty() && made->pad_ == nullptr) return nullptr;
  if (!guids.empty()) made->joysticks_->Use(guids);
  return made;
}

bool PauseButtons::TakePad() {
  if (pad_ != nullptr) return true;
  auto started = input_devices::GamePad::Start();
  if (!started) return false;
  pad_ = std::move(started).value();
  return true;
}

bool PauseButtons::Pressed() {
  if (joysticks_ != nullptr) joysticks_->Update();
  bool any = false;
  if (pad_ != nullptr) {
    pad_->Update();
    const input_devices::PadReading& pad = pad_->reading();
    any = pad.connected && pad.Down(input_devices::PadButton::kPause) && !pad_down_;
    pad_down_ = !pad.connected || pad.Down(input_devices::PadButton::kPause);
  }
  for (Button& button : buttons_) {
    const input_devices::DeviceReading& reading = joysticks_->reading(button.place);
    const bool down =
        reading.connected && button.button < reading.buttons.size() && reading.buttons[button.button] != 0;
    any = any || (down && !button.down);
    button.down = down;
  }
  return any;
}

}  // namespace rodeira::cli

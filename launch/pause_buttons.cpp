#include "launch/pause_buttons.hpp"

#include <optional>
#include <string>
#include <utility>

#include "common/hands/wheel_driver.hpp"
#include "common/hands/wheel_setup.hpp"

namespace rodeira::front {
namespace {

// As the input finds its own.
std::optional<hands::WheelSettings> WheelOf(const launch::Launch& launch, const launch::LaunchNode& node, nodes::Joysticks& joysticks) {
  std::filesystem::path file;
  if (const auto named = node.config->Peek({"config", "wheel"}); named && *named != "~") {
    file = (launch.path().parent_path() / *named).lexically_normal();
  } else {
    for (const nodes::JoystickInfo& info : joysticks.Connected()) {
      if (const auto own = hands::WheelFileOf(info.guid); file.empty() && std::filesystem::exists(own)) file = own;
    }
  }
  return hands::PeekWheel(file, [&](const std::string& device) { return node.config->Peek({"config", "devices", device}); });
}

}  // namespace

std::unique_ptr<PauseButtons> PauseButtons::Open(const launch::Launch& launch) {
  auto made = std::make_unique<PauseButtons>();
  std::vector<std::string> guids;
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name != "input" || node.config->Peek({"config", "source"}) != "joystick") continue;
    if (made->joysticks_ == nullptr) {
      auto started = nodes::Joysticks::Start();
      if (!started) return nullptr;
      made->joysticks_ = std::move(started).value();
      made->joysticks_->Update();
    }
    const auto wheel = WheelOf(launch, node, *made->joysticks_);
    const auto& use = wheel ? wheel->buttons[static_cast<std::size_t>(hands::WheelButton::kPause)] : std::optional<hands::ButtonUse>();
    if (!use) continue;
    made->buttons_.push_back({guids.size(), use->button, true});
    guids.push_back(wheel->devices[use->device].guid);
  }
  if (guids.empty()) return nullptr;
  made->joysticks_->Use(guids);
  return made;
}

bool PauseButtons::Pressed() {
  joysticks_->Update();
  bool any = false;
  for (Button& button : buttons_) {
    const hands::DeviceReading& reading = joysticks_->reading(button.place);
    const bool down = reading.connected && button.button < reading.buttons.size() && reading.buttons[button.button] != 0;
    any = any || (down && !button.down);
    button.down = down;
  }
  return any;
}

}  // namespace rodeira::front

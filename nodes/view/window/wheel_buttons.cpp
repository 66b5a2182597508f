// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/window/wheel_buttons.hpp"

#include <SDL.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "common/vehicle/input_devices/wheel_setup.hpp"

namespace rodeira::nodes {
namespace {

constexpr Uint32 kSubsystems = SDL_INIT_JOYSTICK | SDL_INIT_GAMECONTROLLER;

std::string GuidOf(int index) {
  char guid[33] = {};
  SDL_JoystickGetGUIDString(SDL_JoystickGetDeviceGUID(index), guid, sizeof(guid));
  return guid;
}

}  // namespace

std::unique_ptr<WheelButtons> WheelButtons::Open(const std::vector<WheelButtonUse>& uses) {
  if (uses.empty()) return nullptr;
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  const bool wants_pad =
      std::any_of(uses.begin(), uses.end(), [](const WheelButtonUse& use) { return use.guid.empty() && !use.own; });
  if (SDL_InitSubSystem(kSubsystems) != 0) return nullptr;
  SDL_JoystickEventState(SDL_IGNORE);  // they are read, not listened to
  if (wants_pad) SDL_GameControllerEventState(SDL_IGNORE);
  std::unique_ptr<WheelButtons> made(new WheelButtons());
  for (const WheelButtonUse& use : uses) made->buttons_.push_back({use, nullptr, nullptr, -1, true});
  return made;
}

WheelButtons::~WheelButtons() {
  for (Button& button : buttons_) Drop(button);
  SDL_QuitSubSystem(kSubsystems);
}

// The first device with a file of its own that names a button, as the input looks for its own. Files are looked for
// when a device has come or gone.
void WheelButtons::FindOwn(Button& button) {
  if (button.seen == SDL_NumJoysticks()) return;
  button.seen = SDL_NumJoysticks();
  button.use.guid.clear();
  for (int index = 0; index < button.seen && button.use.guid.empty(); ++index) {
    const std::filesystem::path file = input_devices::WheelFileOf(GuidOf(index));
    std::error_code problem;
    if (!std::filesystem::exists(file, problem)) continue;
    const auto wheel = input_devices::PeekWheel(file, [](const std::string&) { return std::optional<std::string>(); });
    const auto& use = wheel ? wheel->buttons[static_cast<std::size_t>(input_devices::WheelButton::kCamera)]
                            : std::optional<input_devices::ButtonUse>();
    if (use) button.use = {wheel->devices[use->device].guid, static_cast<int>(use->button), true};
  }
}

void WheelButtons::Find(Button& button) {
  SDL_LockJoysticks();
  if (button.use.own) FindOwn(button);
  for (int index = 0; index < SDL_NumJoysticks() && button.joystick == nullptr && button.pad == nullptr; ++index) {
    if (button.use.guid == GuidOf(index)) button.joystick = SDL_JoystickOpen(index);
    const bool is_pad =
        SDL_IsGameController(index) == SDL_TRUE && SDL_JoystickGetDeviceType(index) != SDL_JOYSTICK_TYPE_WHEEL;
    if (button.use.guid.empty() && !button.use.own && is_pad) button.pad = SDL_GameControllerOpen(index);
  }
  SDL_UnlockJoysticks();
}

void WheelButtons::Drop(Button& button) {
  if (button.joystick != nullptr) SDL_JoystickClose(button.joystick);
  if (button.pad != nullptr) SDL_GameControllerClose(button.pad);
  button.joystick = nullptr;
  button.pad = nullptr;
  button.seen = -1;
  button.down = true;
}

bool WheelButtons::Pressed() {
  SDL_JoystickUpdate();
  bool any = false;
  for (Button& button : buttons_) {
    const bool lost = (button.joystick != nullptr && SDL_JoystickGetAttached(button.joystick) == SDL_FALSE) ||
                      (button.pad != nullptr && SDL_GameControllerGetAttached(button.pad) == SDL_FALSE);
    if (lost) Drop(button);
    if (button.joystick == nullptr && button.pad == nullptr) Find(button);
    if (button.joystick == nullptr && button.pad == nullptr) continue;
    const bool down =
        button.pad != nullptr
            ? SDL_GameControllerGetButton(button.pad, static_cast<SDL_GameControllerButton>(button.use.button)) != 0
            : SDL_JoystickGetButton(button.joystick, button.use.button) != 0;
    any = any || (down && !button.down);
    button.down = down;
  }
  return any;
}

}  // namespace rodeira::nodes

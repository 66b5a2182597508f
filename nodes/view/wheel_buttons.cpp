#include "nodes/view/wheel_buttons.hpp"

#include <SDL.h>

namespace rodeira::view {

std::unique_ptr<WheelButtons> WheelButtons::Open(const std::vector<WheelButtonUse>& uses) {
  if (uses.empty()) return nullptr;
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  if (SDL_InitSubSystem(SDL_INIT_JOYSTICK) != 0) return nullptr;
  SDL_JoystickEventState(SDL_IGNORE);  // they are read, not listened to
  std::unique_ptr<WheelButtons> made(new WheelButtons());
  for (const WheelButtonUse& use : uses) made->buttons_.push_back({use, nullptr, true});
  return made;
}

WheelButtons::~WheelButtons() {
  for (Button& button : buttons_) {
    if (button.joystick != nullptr) SDL_JoystickClose(button.joystick);
  }
  SDL_QuitSubSystem(SDL_INIT_JOYSTICK);
}

void WheelButtons::Find(Button& button) {
  SDL_LockJoysticks();
  for (int index = 0; index < SDL_NumJoysticks() && button.joystick == nullptr; ++index) {
    char guid[33] = {};
    SDL_JoystickGetGUIDString(SDL_JoystickGetDeviceGUID(index), guid, sizeof(guid));
    if (button.use.guid == guid) button.joystick = SDL_JoystickOpen(index);
  }
  SDL_UnlockJoysticks();
}

bool WheelButtons::Pressed() {
  SDL_JoystickUpdate();
  bool any = false;
  for (Button& button : buttons_) {
    if (button.joystick != nullptr && SDL_JoystickGetAttached(button.joystick) == SDL_FALSE) {
      SDL_JoystickClose(button.joystick);
      button.joystick = nullptr;
      button.down = true;
    }
    if (button.joystick == nullptr) Find(button);
    if (button.joystick == nullptr) continue;
    const bool down = SDL_JoystickGetButton(button.joystick, button.use.button) != 0;
    any = any || (down && !button.down);
    button.down = down;
  }
  return any;
}

}  // namespace rodeira::view

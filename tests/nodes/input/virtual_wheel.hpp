#pragma once

#include <SDL.h>
#include <gtest/gtest.h>

#include <string>

namespace rodeira {

// A wheel with four axes and eight buttons.
class VirtualWheel {
 public:
  VirtualWheel() { Attach(); }
  ~VirtualWheel() { Detach(); }
  VirtualWheel(const VirtualWheel&) = delete;
  VirtualWheel& operator=(const VirtualWheel&) = delete;

  void Attach() {
    const int index = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_WHEEL, 4, 8, 0);
    ASSERT_GE(index, 0) << SDL_GetError();
    char text[33] = {};
    SDL_JoystickGetGUIDString(SDL_JoystickGetDeviceGUID(index), text, sizeof(text));
    guid_ = text;
    joystick_ = SDL_JoystickOpen(index);
    ASSERT_NE(joystick_, nullptr) << SDL_GetError();
  }
  void Detach() {
    if (joystick_ == nullptr) return;
    const SDL_JoystickID id = SDL_JoystickInstanceID(joystick_);
    for (int index = 0; index < SDL_NumJoysticks(); ++index) {
      if (SDL_JoystickGetDeviceInstanceID(index) == id) SDL_JoystickDetachVirtual(index);
    }
    SDL_JoystickClose(joystick_);
    joystick_ = nullptr;
  }
  void Axis(int axis, int value) { EXPECT_EQ(SDL_JoystickSetVirtualAxis(joystick_, axis, static_cast<Sint16>(value)), 0); }
  void Button(int button, bool down) { EXPECT_EQ(SDL_JoystickSetVirtualButton(joystick_, button, down ? 1 : 0), 0); }
  const std::string& guid() const { return guid_; }

 private:
  SDL_Joystick* joystick_ = nullptr;
  std::string guid_;
};

}  // namespace rodeira

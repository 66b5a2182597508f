// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SDL.h>
#include <gtest/gtest.h>

namespace rodeira {

// A device of SDL's own making, plugged in and out by a test.
class VirtualDevice {
 public:
  VirtualDevice() = default;
  ~VirtualDevice() { Detach(); }
  VirtualDevice(const VirtualDevice&) = delete;
  VirtualDevice& operator=(const VirtualDevice&) = delete;

  void Detach() {
    if (joystick_ == nullptr) return;
    const SDL_JoystickID id = SDL_JoystickInstanceID(joystick_);
    for (int index = 0; index < SDL_NumJoysticks(); ++index) {
      if (SDL_JoystickGetDeviceInstanceID(index) == id) SDL_JoystickDetachVirtual(index);
    }
    SDL_JoystickClose(joystick_);
    joystick_ = nullptr;
  }
  void Axis(int axis, int value) {
    EXPECT_EQ(SDL_JoystickSetVirtualAxis(joystick_, axis, static_cast<Sint16>(value)), 0);
  }
  void Button(int button, bool down) { EXPECT_EQ(SDL_JoystickSetVirtualButton(joystick_, button, down ? 1 : 0), 0); }

 protected:
  // Of what SDL has just attached; below 0 it could not.
  void Open(int index) {
    ASSERT_GE(index, 0) << SDL_GetError();
    joystick_ = SDL_JoystickOpen(index);
    ASSERT_NE(joystick_, nullptr) << SDL_GetError();
  }

 private:
  SDL_Joystick* joystick_ = nullptr;
};

}  // namespace rodeira

#pragma once

#include <string>

#include "tests/nodes/input/virtual_device.hpp"

namespace rodeira {

// A wheel with four axes and eight buttons.
class VirtualWheel : public VirtualDevice {
 public:
  VirtualWheel() { Attach(); }

  void Attach() {
    const int index = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_WHEEL, 4, 8, 0);
    ASSERT_NO_FATAL_FAILURE(Open(index));
    char text[33] = {};
    SDL_JoystickGetGUIDString(SDL_JoystickGetDeviceGUID(index), text, sizeof(text));
    guid_ = text;
  }
  const std::string& guid() const { return guid_; }

 private:
  std::string guid_;
};

// One that SDL knows as no wheel, and as nothing else.
class PlainStick : public VirtualDevice {
 public:
  PlainStick() {
    const int index = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_UNKNOWN, 4, 8, 0);
    Open(index);
    char text[33] = {};
    SDL_JoystickGetGUIDString(SDL_JoystickGetDeviceGUID(index), text, sizeof(text));
    guid_ = text;
  }
  const std::string& guid() const { return guid_; }

 private:
  std::string guid_;
};

}  // namespace rodeira

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tests/nodes/input/virtual_device.hpp"

namespace rodeira {

// A wheel with four axes and eight buttons.
class VirtualWheel : public VirtualDevice {
 public:
  // What SDL takes it for.
  explicit VirtualWheel(SDL_JoystickType type = SDL_JOYSTICK_TYPE_WHEEL) : type_(type) { Attach(); }

  void Attach() {
    const int index = SDL_JoystickAttachVirtual(type_, 4, 8, 0);
    ASSERT_NO_FATAL_FAILURE(Open(index));
    char text[33] = {};
    SDL_JoystickGetGUIDString(SDL_JoystickGetDeviceGUID(index), text, sizeof(text));
    guid_ = text;
  }
  const std::string& guid() const { return guid_; }

 private:
  SDL_JoystickType type_;
  std::string guid_;
};

}  // namespace rodeira

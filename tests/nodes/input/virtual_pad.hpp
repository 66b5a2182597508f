// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/nodes/input/virtual_device.hpp"

namespace rodeira {

// A game pad as SDL maps them: two sticks, two triggers (raw from -32768, where they rest, to 32767), all buttons.
class VirtualPad : public VirtualDevice {
 public:
  VirtualPad() { Attach(); }

  void Attach() {
    SDL_VirtualJoystickDesc desc{};
    desc.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    desc.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
    desc.naxes = SDL_CONTROLLER_AXIS_MAX;
    desc.nbuttons = SDL_CONTROLLER_BUTTON_MAX;
    desc.axis_mask = (1u << SDL_CONTROLLER_AXIS_MAX) - 1;
    desc.button_mask = (1u << SDL_CONTROLLER_BUTTON_MAX) - 1;
    desc.name = "A pad";
    const int index = SDL_JoystickAttachVirtualEx(&desc);
    ASSERT_NO_FATAL_FAILURE(Open(index));
    ASSERT_EQ(SDL_IsGameController(index), SDL_TRUE);
    Axis(SDL_CONTROLLER_AXIS_TRIGGERLEFT, -32768);
    Axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, -32768);
    SDL_JoystickUpdate();
  }
};

}  // namespace rodeira

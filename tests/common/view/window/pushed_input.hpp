// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SDL.h>

#include <string>

// A person's hands on a window without a display: what SDL would tell of mouse and keyboard.
namespace rodeira::window::pushed_input {

inline void MoveTo(int x, int y) {
  SDL_Event event{};
  event.type = SDL_MOUSEMOTION;
  event.motion.x = x;
  event.motion.y = y;
  SDL_PushEvent(&event);
}

inline void Button(int x, int y, bool down, Uint8 button = SDL_BUTTON_LEFT) {
  SDL_Event event{};
  event.type = down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
  event.button.button = button;
  event.button.x = x;
  event.button.y = y;
  SDL_PushEvent(&event);
}

inline void Click(int x, int y) {
  MoveTo(x, y);
  Button(x, y, true);
  Button(x, y, false);
}

inline void Wheel(int notches) {
  SDL_Event event{};
  event.type = SDL_MOUSEWHEEL;
  event.wheel.y = notches;
  SDL_PushEvent(&event);
}

inline void Key(SDL_Scancode scancode, bool down, Uint16 modifiers = KMOD_NONE) {
  SDL_Event event{};
  event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
  event.key.keysym.scancode = scancode;
  event.key.keysym.sym = SDL_GetKeyFromScancode(scancode);
  event.key.keysym.mod = modifiers;
  SDL_PushEvent(&event);
}

// A key with Ctrl or Shift held; they are let go at last.
inline void Press(SDL_Scancode scancode, Uint16 modifiers = KMOD_NONE) {
  Key(scancode, true, modifiers);
  Key(scancode, false, modifiers);
  if (modifiers != KMOD_NONE) Key((modifiers & KMOD_CTRL) != 0 ? SDL_SCANCODE_LCTRL : SDL_SCANCODE_LSHIFT, false);
}

// UTF-8, a letter an event.
inline void Type(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    SDL_Event event{};
    event.type = SDL_TEXTINPUT;
    std::size_t length = 1;
    while (at + length < text.size() && (static_cast<unsigned char>(text[at + length]) & 0xC0) == 0x80) ++length;
    text.copy(event.text.text, length, at);
    SDL_PushEvent(&event);
    at += length;
  }
}

}  // namespace rodeira::window::pushed_input

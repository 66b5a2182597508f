// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SDL.h>

#include <deque>

namespace rodeira::window {

// Hands a window's events to Dear ImGui, one press or release of a button or key a frame, so that a click that comes
// and goes between two frames is still seen as one. The place of the mouse is the events' alone: events that a program
// pushes (SDL_PushEvent) count as a person's do, also without a display.
class Input {
 public:
  // Maps the keys and the clipboard of the current ImGui context.
  Input();
  ~Input();
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  // Gathers what waits, up to `wait_ms` for the first one where none does, and gives as much of it as one frame may
  // have. False as soon as the window should close.
  bool Take(int wait_ms);
  // The window need not close after all.
  void Stay() { closing_ = false; }
  // Whether events wait for a further frame.
  bool waiting() const { return !events_.empty(); }

 private:
  bool Give(const SDL_Event& event);
  std::deque<SDL_Event> events_;
  bool closing_ = false;
};

}  // namespace rodeira::window

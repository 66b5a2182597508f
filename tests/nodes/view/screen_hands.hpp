// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SDL.h>

#include <Eigen/Core>

#include "nodes/view/window/view_window.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {

inline SDL_Event ButtonAt(const Eigen::Vector2d& at, bool down, int button = SDL_BUTTON_LEFT) {
  SDL_Event event{};
  event.type = down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
  event.button.button = static_cast<Uint8>(button);
  event.button.x = static_cast<int>(at.x());
  event.button.y = static_cast<int>(at.y());
  return event;
}

// Down and up there; whether both were for the window.
inline bool Click(ViewWindow& screen, const Eigen::Vector2d& at, int button = SDL_BUTTON_LEFT) {
  const bool down = screen.TakeMouse(ButtonAt(at, true, button));
  return screen.TakeMouse(ButtonAt(at, false, button)) && down;
}

// A nanosecond before it, then the moment: however slow the machine, the window sees time go on, and does not say that
// it stands.
inline Image Shown(ViewWindow& screen, const scene::SceneSnapshot& moment) {
  scene::SceneSnapshot before = moment;
  before.time_ns -= 1;
  screen.Show(before, 1.0);
  screen.Show(moment, 1.0);
  return screen.renderer().Read();
}

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "common/view/scene/camera/camera.hpp"

union SDL_Event;

namespace rodeira::nodes {

// What a menu shows as being so.
struct MenuSight {
  scene::CameraKind camera = scene::CameraKind::kChase;
  bool mirrors = false, sound = false, statistics = false, help = false;
  bool live = false;  // of a run: its car may be placed, its weather changed, its time stopped
  double volume = 0.0;
};

// What was chosen in it: at most one of these.
struct MenuRequest {
  std::optional<int> key;  // as if it were pressed, by SDL's symbols
  std::optional<scene::CameraKind> camera;
  std::optional<std::size_t> weather;  // of weather::NamedWeathers()
  std::optional<double> volume;
};

// The window's menu, by Dear ImGui: what its keys do, to be clicked. Closed it draws nothing, but for its button while
// the mouse is in the upper right corner. For the thread of the window; its OpenGL context must live longer.
class Menu {
 public:
  Menu();
  ~Menu();
  Menu(const Menu&) = delete;
  Menu& operator=(const Menu&) = delete;

  // Opens or closes it.
  void Toggle();
  bool open() const { return open_; }
  // True where the event is the menu's: on it, or on its button.
  bool Take(const SDL_Event& event);
  // Draws it over what the current context shows, and leaves the context's state as it was. Nothing is drawn where
  // OpenGL is older than 3.0.
  MenuRequest Draw(const MenuSight& sight, int width_px, int height_px);
  // Whether the next picture of it may be another one although nothing else happens.
  bool is_restless() const { return unrest_ > 0; }

 private:
  struct Panels;  // made when it is first seen
  struct Place {
    float left = 0.0F, top = 0.0F, right = 0.0F, bottom = 0.0F;
    bool Holds(int x_px, int y_px) const;
  };
  bool Sort(const SDL_Event& event);
  MenuRequest DrawEntries(const MenuSight& sight);

  std::unique_ptr<Panels> panels_;
  bool open_ = false;
  bool near_ = false;  // the mouse is where the button comes
  bool held_ = false;  // a button of the mouse went down on it
  int unrest_ = 0;     // pictures until it is at rest
  Place place_;        // of the panel, as it was drawn
  int width_px_ = 0;   // of the window, likewise
};

}  // namespace rodeira::nodes

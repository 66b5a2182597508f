// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "nodes/view/frame/surface.hpp"

namespace rodeira::nodes {

// What a window shows before its first picture: how far it has come as a bar, and in words in its title.
class Loading {
 public:
  // Of a window; anything else shows nothing.
  Loading(Surface& surface, std::string title) : surface_(surface), title_(std::move(title)) {}

  // `share` of the way, 0 to 1; `what` comes next. The system is told that the window lives; it is shown at once, but
  // for the same words within kAgain_s.
  void Show(double share, const std::string& what);
  // Something that takes an unknown time has been at it so many seconds: a piece of the bar goes to and fro.
  // Always shown at once.
  void ShowWork(double seconds, const std::string& what);
  // The title alone again.
  static void End(const std::string& title);

 private:
  static constexpr double kAgain_s = 0.03;

  Surface& surface_;
  std::string title_, what_;
  double shown_wall_s_ = 0.0;
};

// "Rodeira: N222, 30 %: the ground is built".
std::string LoadingTitle(const std::string& title, double share, const std::string& what);
// "Rodeira, 2 s: the world is read".
std::string WorkTitle(const std::string& title, double seconds, const std::string& what);
// The bar alone, over the whole of the current OpenGL context's drawing area: in its middle, six tenths of its width.
void DrawLoadingBar(int width_px, int height_px, double share);
// The same with a fifth of it bright, which goes to its right end in a second, and back in another.
void DrawWorkBar(int width_px, int height_px, double seconds);

}  // namespace rodeira::nodes

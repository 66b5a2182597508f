// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::nodes {

// Where a picture is drawn: a framebuffer of the current OpenGL context (0: the surface's own) and its size.
struct PictureTarget {
  unsigned framebuffer = 0;
  int width_px = 0;
  int height_px = 0;
};

// What is drawn and read from now on is drawn and read there.
void Bind(const PictureTarget& target);

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nodes/view/frame/picture_target.hpp"

namespace rodeira::nodes {

// Pixels of one size, with as many samples as the quality wants, that are then handed over into another one's texture.
// Made, used and destroyed while the same OpenGL context is current.
class EyeBuffer {
 public:
  // `format`: of the textures that it will be handed over into (GL_RGBA8, GL_SRGB8_ALPHA8). `samples`: a pixel; 0: one.
  EyeBuffer(int width_px, int height_px, int samples, unsigned format);
  ~EyeBuffer();
  EyeBuffer(const EyeBuffer&) = delete;
  EyeBuffer& operator=(const EyeBuffer&) = delete;

  // Whether OpenGL has made it.
  bool whole() const { return whole_; }
  const PictureTarget& target() const { return target_; }
  // What was drawn, byte for byte, into a texture of the same size.
  void HandOverInto(unsigned texture);

 private:
  PictureTarget target_;
  unsigned colour_ = 0, depth_ = 0, resolved_ = 0;
  bool whole_ = false;
};

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#define GL_GLEXT_PROTOTYPES
#include "nodes/view/frame/eye_buffer.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

namespace rodeira::nodes {

EyeBuffer::EyeBuffer(int width_px, int height_px, int samples, unsigned format) : target_{0, width_px, height_px} {
  const auto buffer = [&](unsigned& name, unsigned of_format) {
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, of_format, width_px, height_px);
  };
  buffer(colour_, format);
  buffer(depth_, GL_DEPTH_COMPONENT24);
  glBindRenderbuffer(GL_RENDERBUFFER, 0);
  glGenFramebuffers(1, &resolved_);
  glGenFramebuffers(1, &target_.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  whole_ = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

EyeBuffer::~EyeBuffer() {
  glDeleteFramebuffers(1, &target_.framebuffer);
  glDeleteFramebuffers(1, &resolved_);
  glDeleteRenderbuffers(1, &colour_);
  glDeleteRenderbuffers(1, &depth_);
}

void EyeBuffer::HandOverInto(unsigned texture) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target_.framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  glBlitFramebuffer(0, 0, target_.width_px, target_.height_px, 0, 0, target_.width_px, target_.height_px,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace rodeira::nodes

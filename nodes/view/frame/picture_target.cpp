// SPDX-License-Identifier: Apache-2.0
#define GL_GLEXT_PROTOTYPES
#include "nodes/view/frame/picture_target.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

namespace rodeira::nodes {

void Bind(const PictureTarget& target) { glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer); }

}  // namespace rodeira::nodes

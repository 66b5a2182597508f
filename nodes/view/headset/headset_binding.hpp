// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rodeira::nodes {

// What an OpenXR session has to know of the OpenGL context that is current on this thread.
struct HeadsetBinding {
  std::vector<const char*> extensions;    // of OpenXR, that a runtime needs for it
  std::shared_ptr<const void> structure;  // XrSessionCreateInfo's `next`
};
// None where there is no context, or one by neither GLX nor EGL.
std::optional<HeadsetBinding> BindingOfCurrentContext();

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openxr/openxr.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "nodes/view/frame/eye_buffer.hpp"
#include "nodes/view/headset/headset.hpp"

namespace rodeira::nodes {

inline constexpr XrViewConfigurationType kTwoEyes = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

// One of OpenXR's structures, empty but for what it is.
template <class Structure>
Structure Of(XrStructureType type) {
  Structure structure{};
  structure.type = type;
  return structure;
}

// A place of OpenXR's (x right, y up, z backward) in the driver's seat, and the edges of its picture.
scene::HeadsetEye EyeOf(const XrPosef& pose, const XrFovf& view);

// The pictures of an OpenXR session's two eyes.
class HeadsetEyes {
 public:
  // Wrong input where the runtime has no two eyes, or no pictures that OpenGL can draw.
  static base::Result<std::unique_ptr<HeadsetEyes>> Make(XrInstance instance, XrSystemId system, XrSession session,
                                                         XrSpace space, Quality quality);
  ~HeadsetEyes();

  using Views = std::array<XrCompositionLayerProjectionView, 2>;
  // Where the eyes will be at a time, and what they see there. None where the runtime does not know where the head is.
  // Failed where it has lost the pictures.
  base::Result<std::optional<Views>> Draw(XrTime time, const Headset::DrawEye& draw);

 private:
  struct Eye {
    XrSwapchain chain = XR_NULL_HANDLE;
    std::vector<unsigned> textures;
    std::unique_ptr<EyeBuffer> buffer;
  };
  HeadsetEyes(XrSession session, XrSpace space) : session_(session), space_(space) {}
  base::Status MakeEye(const XrViewConfigurationView& shape, std::int64_t format, int samples, Eye& eye);
  bool DrawOne(Eye& eye, const scene::HeadsetEye& from, const Headset::DrawEye& draw);

  XrSession session_;
  XrSpace space_;
  std::array<Eye, 2> eyes_;
};

}  // namespace rodeira::nodes

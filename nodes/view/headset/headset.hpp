// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "common/core/base/result.hpp"
#include "common/view/scene/camera/headset_eye.hpp"
#include "nodes/view/frame/picture_target.hpp"
#include "nodes/view/frame/quality.hpp"

namespace rodeira::nodes {

// A headset's two eyes, by whatever OpenXR runtime this PC has. For one thread: its OpenGL context is current from
// before it is opened until after it is gone.
class Headset {
 public:
  // Wrong input, a sentence, where this Rodeira was built without OpenXR, the PC has no runtime, the runtime no
  // headset, or the two do not agree about OpenGL.
  static base::Result<std::unique_ptr<Headset>> Open(Quality quality);
  virtual ~Headset() = default;

  // As the runtime calls it.
  virtual const std::string& name() const = 0;
  // Waits until the runtime wants the next pictures. False, at once, where it wants none now: the headset is not worn
  // yet, or it has gone.
  virtual bool Begin() = 0;
  using DrawEye = std::function<void(const scene::HeadsetEye& eye, const PictureTarget& target)>;
  // Behind a Begin that said true: asks for each eye's picture where its eye will be when it is seen, and hands them
  // over.
  virtual void Show(const DrawEye& draw) = 0;
  // It will show nothing more, and why; empty while it may.
  virtual const std::string& gone() const = 0;
};

}  // namespace rodeira::nodes

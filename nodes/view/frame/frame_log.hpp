// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>

#include "common/core/base/result.hpp"
#include "common/view/scene/camera/camera.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"

namespace rodeira::nodes {

// What a window showed and when, a line (CSV) a picture: the time on the wall at which it was handed to the display,
// the simulated time that it shows, where the followed vehicle is in it, and the eye. For the proof that motion is
// even.
class FrameLog {
 public:
  // Wrong input where the file cannot be written.
  static base::Result<std::unique_ptr<FrameLog>> Open(const std::filesystem::path& file);
  // `followed`: a body of the moment, as scene::BodyAt counts; without it no line is written.
  void Add(double wall_s, const scene::SceneSnapshot& moment, std::size_t followed, const scene::Camera& camera);

 private:
  explicit FrameLog(std::ofstream file) : file_(std::move(file)) {}

  std::ofstream file_;
};

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "common/editor/background.hpp"

namespace rodeira::nodes {

// Reads the map's background beside the drawing, so that the desk stays usable meanwhile.
class PictureLoader {
 public:
  PictureLoader() = default;
  ~PictureLoader() { Stop(); }
  PictureLoader(const PictureLoader&) = delete;
  PictureLoader& operator=(const PictureLoader&) = delete;

  // Begins to read these bytes (a copy of them), if `state` is another one than before. What was read so far is given
  // up.
  void Want(const std::string& bytes, std::uint64_t state);
  // Takes what has become ready.
  void Poll();

  // None: there is no picture, or not yet. While it is loading it may be a preview.
  const std::shared_ptr<const editor::Pyramid>& picture() const { return picture_; }
  bool loading() const { return thread_.joinable(); }
  double share() const { return share_; }
  // Once, why a picture could not be read.
  std::string TakeProblem() { return std::exchange(problem_, {}); }

 private:
  void Stop();

  std::uint64_t state_ = 0;
  std::shared_ptr<const editor::Pyramid> picture_, made_;  // the latter by the thread, under the lock
  std::mutex lock_;
  std::string problem_, found_problem_;
  std::thread thread_;
  std::atomic<double> share_{0.0};
  std::atomic<bool> stop_{false}, done_{false};
};

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#include "nodes/editor/picture_loader.hpp"

#include <utility>

namespace rodeira::nodes {

void PictureLoader::Stop() {
  if (!thread_.joinable()) return;
  stop_ = true;
  thread_.join();
  stop_ = false;
}

void PictureLoader::Want(const std::string& bytes, std::uint64_t state) {
  if (state == state_) return;
  state_ = state;
  Stop();
  picture_.reset();
  made_.reset();
  found_problem_.clear();
  if (bytes.empty()) return;
  share_ = 0.0;
  done_ = false;
  thread_ = std::thread([this, bytes] {
    const auto progress = [this](double share) {
      share_ = share;
      return !stop_;
    };
    const auto sooner = [this](std::shared_ptr<const editor::Pyramid> preview) {
      const std::lock_guard guard(lock_);
      made_ = std::move(preview);
    };
    auto picture = editor::ReadPyramid(bytes, progress, sooner);
    if (picture)
      sooner(std::move(picture).value());
    else
      found_problem_ = "the background cannot be shown: " + picture.error().Text();
    done_ = true;
  });
}

void PictureLoader::Poll() {
  if (!thread_.joinable()) return;
  const bool ended = done_;
  if (ended) thread_.join();
  {
    const std::lock_guard guard(lock_);
    if (made_ != nullptr) picture_ = std::exchange(made_, nullptr);
  }
  if (!ended) return;
  if (!found_problem_.empty()) picture_.reset();  // of what is broken not even the preview
  problem_ = std::exchange(found_problem_, {});
}

}  // namespace rodeira::nodes

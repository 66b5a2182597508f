#include "nodes/editor/picture_loader.hpp"

#include <utility>

namespace rodeira::desk {

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
    auto pixels = editor::DecodePicture(bytes, [this](double share) {
      share_ = share;
      return !stop_;
    });
    if (pixels) made_ = std::make_shared<const editor::Pyramid>(std::move(pixels).value());
    else found_problem_ = "the background cannot be shown: " + pixels.error().Text();
    done_ = true;
  });
}

void PictureLoader::Look() {
  if (!thread_.joinable() || !done_) return;
  thread_.join();
  picture_ = std::move(made_);
  made_.reset();
  problem_ = std::exchange(found_problem_, {});
}

}  // namespace rodeira::desk

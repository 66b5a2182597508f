// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/background_sync.hpp"

#include <unistd.h>

#include <cerrno>
#include <utility>

#include "common/core/base/put_in_place.hpp"

namespace rodeira::record {

BackgroundSync::BackgroundSync(int file, std::filesystem::path path)
    : thread_([this, file, path = std::move(path)](const std::stop_token& done) { Work(done, file, path); }) {}

void BackgroundSync::Request() {
  {
    const std::lock_guard lock(mutex_);
    is_requested_ = true;
  }
  requested_.notify_one();
}

void BackgroundSync::Work(const std::stop_token& done, int file, const std::filesystem::path& path) {
  base::SyncName(path);
  while (true) {
    {
      std::unique_lock lock(mutex_);
      requested_.wait(lock, done, [this] { return is_requested_; });
      if (done.stop_requested()) return;
      is_requested_ = false;
    }
    // A pipe or a device has nothing to wait for (EINVAL), nor have some file systems (EROFS).
    if (::fdatasync(file) != 0 && errno != EINVAL && errno != EROFS && error_ == 0) error_ = errno;
  }
}

}  // namespace rodeira::record

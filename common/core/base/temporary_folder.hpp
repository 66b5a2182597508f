// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

#include "common/core/base/result.hpp"

namespace rodeira::base {

// A folder of its own below the system's temporary one, removed with everything in it at the end. What a killed process
// has left there is removed by the next one of this user that makes a folder for the same purpose: a living process
// keeps its folder locked.
class TemporaryFolder {
 public:
  // Its name begins with "rodeira-WHAT-". Failed where none can be made.
  static Result<TemporaryFolder> Make(std::string_view what);
  TemporaryFolder(TemporaryFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}
  std::filesystem::path path_;
  int lock_ = -1;  // the open folder, locked
};

}  // namespace rodeira::base

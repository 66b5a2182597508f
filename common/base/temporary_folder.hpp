#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

#include "common/base/result.hpp"

namespace rodeira::base {

// A folder of its own below the system's temporary one, removed with everything in it at the end.
class TemporaryFolder {
 public:
  // Its name begins with "rodeira-WHAT-". Failed where none can be made.
  static Result<TemporaryFolder> Make(std::string_view what);
  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace rodeira::base

#pragma once

#include <filesystem>

#include "common/base/result.hpp"

namespace rodeira::fmi {

// A temporary folder of its own, taken away at the end.
class Folder {
 public:
  static base::Result<Folder> Make();
  explicit Folder(std::filesystem::path path) : path_(std::move(path)) {}
  ~Folder();
  Folder(Folder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  Folder& operator=(Folder&&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Lays a ZIP archive's files out in a new folder. Wrong input where it is none, is damaged, holds more than 1 GiB, or a name in it
// leads out of the folder.
base::Result<Folder> Unpack(const std::filesystem::path& archive);

}  // namespace rodeira::fmi

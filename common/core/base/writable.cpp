// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/writable.hpp"

#include "common/core/base/files.hpp"

namespace rodeira::base {

Status CheckWritable(const std::filesystem::path& path) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem))
    return Failed("file.is_folder", "the file cannot be written: a folder has that name", path.string());
  std::filesystem::path beside = path;
  beside += ".tried";
  if (auto status = WriteWhole(beside, std::string_view()); !status)
    return Failed(status.error().id, status.error().message, path.string());
  std::filesystem::remove(beside, problem);
  return {};
}

}  // namespace rodeira::base

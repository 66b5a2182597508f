// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/nearest_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "common/core/base/suggest.hpp"

namespace rodeira::base {

std::string NearestFile(const std::filesystem::path& path) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::vector<std::string> names;
  std::error_code problem;
  for (std::filesystem::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    std::error_code other;
    const bool alike = entry->path().extension() == path.extension() || entry->path().stem() == path.stem();
    if (alike && entry->is_regular_file(other)) names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  const std::string nearest = NearestName(path.filename().string(), names);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

std::string NoSuchFile(const std::filesystem::path& path) {
  std::error_code problem;
  if (std::filesystem::exists(path, problem)) return "";
  if (!std::filesystem::is_symlink(path, problem)) return "there is no such file" + NearestFile(path);
  return fmt::format("this is a link to '{}', which is not there",
                     std::filesystem::read_symlink(path, problem).string());
}

}  // namespace rodeira::base

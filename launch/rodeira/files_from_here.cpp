// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/files_from_here.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <system_error>

#include "common/core/base/nearest_file.hpp"
#include "common/core/config/quoted.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxUp = 8;  // how often a relative name may go up; launch::Files lays out as many folders

bool IsFile(const std::string& word) {
  std::error_code problem;
  const bool can_be = word.find('/') != std::string::npos || fs::path(word).has_extension();
  return can_be && fs::is_regular_file(word, problem);
}

// `2.5`, `10.0.0.1` and `pc.lan` are no files; these are, also without a folder before them.
bool HasExtensionOfAFile(const fs::path& path) {
  constexpr std::array<std::string_view, 10> kExtensions = {".yaml", ".yml",  ".xodr", ".csv", ".bt",
                                                            ".crg",  ".mcap", ".fmu",  ".so",  ".motors"};
  return std::ranges::find(kExtensions, path.extension().string()) != kExtensions.end();
}

// A file that is in neither place, a misspelt name: in a folder of the current directory alone, or without a folder
// where no file beside the launch file alone has nearly that name.
bool IsMissingHere(const std::string& word, const fs::path& launch_folder) {
  std::error_code problem;
  const fs::path path(word);
  if (!path.is_relative() || fs::exists(path, problem)) return false;
  if (path.has_parent_path())
    return path.has_extension() && fs::is_directory(path.parent_path(), problem) &&
           !fs::exists(launch_folder / path.parent_path(), problem);
  return HasExtensionOfAFile(path) && !fs::exists(launch_folder / path, problem) &&
         (!base::NearestFile(path).empty() || base::NearestFile(launch_folder / path).empty());
}

std::string Replace(const std::string& value, const std::function<std::string(const std::string&)>& rename) {
  if (IsFile(value)) {
    const std::string renamed = rename(value);
    return renamed == value ? value : config::Quoted(renamed);
  }
  constexpr std::string_view kBetween = "{}[],: \"'";
  std::string text;
  for (std::size_t at = 0; at < value.size();) {
    const std::size_t end = std::min(value.find_first_of(kBetween, at), value.size());
    const std::string word = value.substr(at, end - at);
    text += IsFile(word) ? rename(word) : word;
    if (end < value.size()) text += value[end];
    at = end + 1;
  }
  return text;
}

std::string Absolute(const std::string& file) { return fs::absolute(file).lexically_normal().string(); }

}  // namespace

std::string WithFilesFromHere(const std::string& value) { return Replace(value, Absolute); }

launch::Overrides WithFilesFromHere(const launch::Overrides& overrides, const fs::path& launch_file) {
  const fs::path folder = fs::absolute(launch_file).lexically_normal().parent_path();
  const auto rename = [&](const std::string& file) {
    if (fs::path(file).is_absolute()) return file;
    const fs::path relative = fs::path(Absolute(file)).lexically_relative(folder);
    return std::ranges::count(relative, fs::path("..")) > kMaxUp ? Absolute(file) : relative.string();
  };
  launch::Overrides renamed = overrides;
  for (auto& [key, value] : renamed) {
    if (key.ends_with(".config.file")) continue;
    value = IsMissingHere(value, folder) ? config::Quoted(rename(value)) : Replace(value, rename);
  }
  return renamed;
}

}  // namespace rodeira::cli

// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/visual_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "common/core/base/files.hpp"

namespace rodeira::road {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRoot = "world.osgb";

bool ReadDigest(const std::string& word, base::Digest& digest) {
  const auto end = word.data() + word.size();
  return word.size() == 16 && std::from_chars(word.data(), end, digest, 16).ptr == end;
}

}  // namespace

VisualContents ReadVisualContents(const fs::path& manifest) {
  VisualContents contents;
  std::ifstream file(manifest);
  constexpr std::string_view kSeen = "# seen: ", kContent = "# content_hash: ";
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(kSeen)) contents.seen = line.substr(kSeen.size());
    if (line.starts_with(kContent)) contents.content_hash = line.substr(kContent.size());
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    std::string hash, source, more;
    VisualContents::Listed listed;
    base::Digest made_from = 0;
    const bool whole = words >> hash >> source >> listed.name && !(words >> more) && ReadDigest(hash, listed.hash) &&
                       ReadDigest(source, made_from);
    if (whole && fs::path(listed.name).is_relative())
      contents.files.push_back(std::move(listed));
    else
      contents.broken.push_back(line);
  }
  return contents;
}

std::vector<base::Error> VisualProblems(const fs::path& folder, const std::string& content_hash) {
  std::error_code problem;
  const fs::path manifest = folder / kVisualManifest;
  if (!fs::is_regular_file(manifest, problem)) {
    if (!fs::exists(folder / kRoot, problem)) return {};
    return {
        base::WrongInput("world.built_file_missing",
                         fmt::format("there is '{}' but no '{}', which names every file of what is seen with its hash",
                                     kRoot, kVisualManifest),
                         folder.string())};
  }
  std::vector<base::Error> problems;
  const VisualContents contents = ReadVisualContents(manifest);
  if (contents.content_hash != content_hash) {
    problems.push_back(base::WrongInput(
        "world.built_file_changed",
        fmt::format("it was written from a world with the content hash '{}'; this folder's world has '{}'",
                    contents.content_hash, content_hash),
        manifest.string()));
  }
  for (const std::string& line : contents.broken)
    problems.push_back(base::WrongInput(
        "world.wrong_manifest", fmt::format("the line '{}' names no file with its hash", line), manifest.string()));
  const bool root = std::any_of(contents.files.begin(), contents.files.end(),
                                [](const auto& listed) { return listed.name == kRoot; });
  if (!root)
    problems.push_back(base::WrongInput("world.built_file_missing",
                                        fmt::format("'{}', by which all others are found, is not named", kRoot),
                                        manifest.string()));
  for (const VisualContents::Listed& listed : contents.files) {
    const auto bytes = base::ReadText(folder / listed.name, 1u << 30);
    if (!bytes)
      problems.push_back(base::WrongInput("world.built_file_missing", "this file of what is seen is missing",
                                          (folder / listed.name).string()));
    else if (base::Hash(bytes.value()) != listed.hash)
      problems.push_back(base::WrongInput("world.built_file_changed",
                                          "this file of what is seen is not as it was written",
                                          (folder / listed.name).string()));
  }
  return problems;
}

}  // namespace rodeira::road

// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/start_window/start_files.hpp"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "common/core/base/files.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostOfAText = 4u << 20;  // a larger file is no person's own text

std::vector<fs::path> FilesIn(const fs::path& folder, const std::set<std::string>& endings) {
  std::vector<fs::path> files;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
    std::error_code unread;
    if (entry->is_regular_file(unread) && endings.contains(entry->path().extension().string()))
      files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> NewestIn(const fs::path& folder) {
  std::vector<std::pair<fs::file_time_type, fs::path>> dated;
  for (const fs::path& file : FilesIn(folder, {".mcap"})) {
    std::error_code unread;
    const auto written = fs::last_write_time(file, unread);
    if (!unread) dated.emplace_back(written, file);
  }
  std::sort(dated.begin(), dated.end(),
            [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  std::vector<fs::path> files;
  for (const auto& [written, file] : dated) {
    if (files.size() < StartFiles::kRecent) files.push_back(file);
  }
  return files;
}

// The text of its line that begins with `key`; empty where there is none.
std::string LineOf(const fs::path& file, const std::string& key) {
  const auto text = base::ReadText(file, kMostOfAText);
  if (!text) return "";
  const std::string all = "\n" + text.value(), begin = "\n" + key;
  const std::size_t at = all.find(begin);
  return at == std::string::npos ? "" : all.substr(at + begin.size(), all.find('\n', at + 1) - at - begin.size());
}

// `rodeira: world/2` of a world, for one.
bool IsOfKind(const fs::path& file, const std::string& kind) {
  if (file.extension() != ".yaml") return true;  // its ending says what it is
  return LineOf(file, "rodeira:").find(" " + kind + "/") != std::string::npos;
}

// Files of one folder that are whole ones of their kind.
std::vector<fs::path> WholeIn(const fs::path& folder, const std::string& kind, const std::set<std::string>& endings) {
  std::vector<fs::path> files = FilesIn(folder, endings);
  std::erase_if(files, [&](const fs::path& file) { return !IsOfKind(file, kind); });
  std::string included;
  for (const fs::path& file : files) included += LineOf(file, "include:");
  std::erase_if(files,
                [&](const fs::path& file) { return included.find(file.filename().string()) != std::string::npos; });
  return files;
}

std::vector<fs::path> FilesFor(const fs::path& root, const fs::path& own, const std::string& kind,
                               const std::set<std::string>& endings) {
  std::vector<fs::path> files = FilesIn(own, endings);
  const auto add = [&files](const std::vector<fs::path>& more) { files.insert(files.end(), more.begin(), more.end()); };
  std::vector<fs::path> folders;
  std::error_code problem;
  for (fs::directory_iterator entry(own, problem), end; !problem && entry != end; entry.increment(problem)) {
    std::error_code unread;
    if (entry->is_directory(unread)) folders.push_back(entry->path());
  }
  std::sort(folders.begin(), folders.end());
  for (const fs::path& folder : folders) add(WholeIn(folder, kind, endings));
  add(WholeIn(root, kind, endings));
  return files;
}

}  // namespace

void StartFiles::FindRecordings() { recordings = NewestIn(data); }

StartFiles FindStartFiles(const fs::path& root, const fs::path& data, const fs::path& config) {
  StartFiles files;
  files.root = root;
  files.data = data;
  files.FindRecordings();
  files.wheels = FilesIn(config / "wheels", {".yaml"});
  if (root.empty()) return files;
  files.worlds = FilesFor(root, root / "configs/worlds", "world", {".yaml", ".xodr"});
  files.vehicles = FilesFor(root, root / "configs/vehicles", "vehicle", {".yaml"});
  return files;
}

fs::path FindStartRoot(const std::vector<fs::path>& near) {
  for (const fs::path& begin : near) {
    for (fs::path folder = begin; !folder.empty(); folder = folder.parent_path()) {
      std::error_code problem;
      if (fs::is_regular_file(folder / kStartLaunch, problem) && fs::is_directory(folder / "configs", problem))
        return folder;
      if (folder == folder.parent_path()) break;
    }
  }
  return {};
}

std::string ShownName(const fs::path& root, const fs::path& file) {
  for (const char* own : {"configs/worlds", "configs/vehicles", "."}) {
    const fs::path relative = file.lexically_normal().lexically_relative((root / own).lexically_normal());
    if (!relative.empty() && *relative.begin() != "..") return relative.string();
  }
  return file.string();
}

}  // namespace rodeira::cli

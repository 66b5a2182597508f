// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/start_window/start_files.hpp"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "launch/rodeira/input_files.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

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

std::vector<fs::path> PathsOf(InputKind kind, const std::vector<InputFolder>& folders) {
  std::vector<fs::path> paths;
  for (const InputFile& file : FindInputFiles(kind, folders)) paths.push_back(file.path);
  return paths;
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
  const std::vector<InputFolder> folders{{root, "Rodeira"}, {data, "yours"}};
  files.worlds = PathsOf(InputKind::kWorld, folders);
  files.vehicles = PathsOf(InputKind::kVehicle, folders);
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

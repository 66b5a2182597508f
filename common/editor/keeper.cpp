// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <system_error>

#include "common/core/base/files.hpp"
#include "common/editor/store.hpp"
#include "common/world/traffic_map/companion_text.hpp"

namespace rodeira::editor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLines = "map.motors";  // without the picture
constexpr const char* kPicture = "picture";
constexpr const char* kCompanion = "companion.yaml";
constexpr const char* kOf = "of";  // the file that it belongs to
constexpr const char* kLock = "lock";

// The open lock, or -1 where a running process holds it.
int Lock(const fs::path& folder) {
  const int file = ::open((folder / kLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return -1;
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  ::close(file);
  return -1;
}

}  // namespace

base::Result<Keeper> Keeper::Make(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  for (int number = 0; number < 1000; ++number) {
    const fs::path own = folder / fmt::format("{}-{}", ::getpid(), number);
    if (!fs::create_directory(own, problem)) {
      if (problem)
        return base::Failed("edit.cannot_keep_work", "unsaved work cannot be kept: " + problem.message(), own.string());
      continue;  // a process with our number left it
    }
    const int lock = Lock(own);
    if (lock >= 0) return Keeper(folder, own, lock);
  }
  return base::Failed("edit.cannot_keep_work", "unsaved work cannot be kept: no folder can be made", folder.string());
}

Keeper::Keeper(Keeper&& other) noexcept
    : all_(std::move(other.all_)),
      own_(std::move(other.own_)),
      lock_(std::exchange(other.lock_, -1)),
      picture_state_(other.picture_state_) {}

Keeper::~Keeper() {
  if (lock_ < 0) return;
  std::error_code ignored;
  if (!fs::exists(own_ / kLines, ignored)) fs::remove_all(own_, ignored);
  ::close(lock_);
}

base::Status Keeper::Keep(const Document& document, const fs::path& of, std::uint64_t picture_state) {
  if (picture_state_ != picture_state) {
    if (auto status = base::WriteWhole(own_ / kPicture, document.map.picture); !status) return status;
    picture_state_ = picture_state;
  }
  traffic_map::MapFile lines;
  lines.curves = document.map.curves, lines.lanes = document.map.lanes, lines.connections = document.map.connections,
  lines.scale = document.map.scale;
  std::error_code problem;
  const fs::path whole = of.empty() ? of : fs::absolute(of, problem);
  if (auto status = base::WriteWhole(own_ / kOf, whole.string()); !status) return status;
  if (auto status = base::WriteWhole(own_ / kCompanion, traffic_map::CompanionText(document.companion)); !status)
    return status;
  return traffic_map::SaveMap(lines, own_ / kLines);
}

void Keeper::Forget() {
  std::error_code ignored;
  for (const char* name : {kLines, kPicture, kCompanion, kOf}) fs::remove(own_ / name, ignored);
  picture_state_.reset();
}

std::vector<Keeper::Left> Keeper::Found() const {
  std::vector<std::pair<fs::file_time_type, Left>> found;
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(all_, problem)) {
    if (entry.path() == own_ || !entry.is_directory(problem)) continue;
    const int lock = Lock(entry.path());
    if (lock < 0) continue;
    ::close(lock);
    if (!fs::exists(entry.path() / kLines, problem)) {
      fs::remove_all(entry.path(), problem);
      continue;
    }
    const auto of = base::ReadText(entry.path() / kOf);
    found.emplace_back(fs::last_write_time(entry.path() / kLines, problem),
                       Left{entry.path(), of.ok() ? of.value() : ""});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first, a.second.folder) < std::tie(b.first, b.second.folder);
  });
  std::vector<Left> left;
  for (auto& [time, one] : found) left.push_back(std::move(one));
  return left;
}

base::Result<Opened> Keeper::Restore(const Left& left) {
  auto file = traffic_map::LoadMap(left.folder / kLines);
  if (!file) return file.error();
  Opened opened;
  opened.document.map = std::move(file).value();
  auto picture = base::ReadText(left.folder / kPicture, traffic_map::kMaxBytes);
  if (picture) opened.document.map.picture = std::move(picture).value();
  const auto text = base::ReadText(left.folder / kCompanion);
  if (text && !text.value().empty()) {
    const auto heights = traffic_map::ParseHeights(text.value(), left.folder / kCompanion);
    if (!heights) return heights.error();
    opened.document.companion = heights.value();
  }
  // What its own file says now is what was loaded: saving keeps the companion's comments.
  if (!left.of.empty()) {
    const auto now = Open(left.of);
    if (now) opened.companion = now.value().companion;
  }
  return opened;
}

void Keeper::Discard(const Left& left) {
  std::error_code ignored;
  fs::remove_all(left.folder, ignored);
}

}  // namespace rodeira::editor

// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/temporary_folder.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

namespace rodeira::base {
namespace fs = std::filesystem;
namespace {

constexpr int kLetters = 6;  // that mkdtemp asks for

// The open folder, locked; -1 where it is not there or another process holds it.
int Lock(const fs::path& folder, bool wait) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return -1;
  if (::flock(file, LOCK_EX | (wait ? 0 : LOCK_NB)) == 0) return file;
  ::close(file);
  return -1;
}

// A sweeping process may have been faster between the making of a folder and its locking.
bool IsThere(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 && status.st_nlink > 0;
}

// Folders of this purpose that no process holds any more.
void Sweep(const fs::path& where, const std::string& start) {
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(where, problem)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(start) || name.size() != start.size() + kLetters) continue;
    struct stat status {};
    if (::lstat(entry.path().c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != ::geteuid())
      continue;
    const int file = Lock(entry.path(), false);
    if (file < 0) continue;
    std::error_code ignored;
    fs::remove_all(entry.path(), ignored);
    ::close(file);
  }
}

}  // namespace

Result<TemporaryFolder> TemporaryFolder::Make(std::string_view what) {
  std::error_code problem;
  const fs::path where = fs::temp_directory_path(problem);
  if (problem)
    return Failed("file.cannot_make_folder", "no temporary folder can be made: " + problem.message(), where.string());
  const std::string start = "rodeira-" + std::string(what) + "-";
  Sweep(where, start);
  for (;;) {
    std::string name = (where / start).string() + std::string(kLetters, 'X');
    if (::mkdtemp(name.data()) == nullptr)
      return Failed("file.cannot_make_folder", std::string("no temporary folder can be made: ") + std::strerror(errno),
                    where.string());
    const int lock = Lock(name, true);
    if (lock >= 0 && IsThere(lock)) return TemporaryFolder(name, lock);
    if (lock < 0 && fs::exists(name, problem)) return TemporaryFolder(name, -1);  // a file system without locks
    if (lock >= 0) ::close(lock);
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace rodeira::base

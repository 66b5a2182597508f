// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program (LD_PRELOAD): notes, in order, what happens to files below a folder, and what of each file
// is on the disk at each sync. A loss of power may take everything else.
//   DISK_JOURNAL=FOLDER        where the journal goes ("journal") and what was on the disk at each sync ("1", "2", …)
//   DISK_JOURNAL_OF=FOLDER     the folder looked at
// Lines: "write INODE", "sync INODE COPY", "sync_all", "names FOLDER", "rename INODE FROM TO".
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>

namespace {

struct Journal {
  Journal() {
    const char* to = std::getenv("DISK_JOURNAL");
    const char* of = std::getenv("DISK_JOURNAL_OF");
    if (to != nullptr) folder = to;
    if (of != nullptr) watched = of;
  }
  std::string folder, watched;
  std::mutex mutex;
};

Journal& The() {
  static Journal journal;
  return journal;
}

template <class Function>
Function Next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

std::string PathOf(int fd) {
  char path[PATH_MAX];
  const ssize_t length = ::readlink(("/proc/self/fd/" + std::to_string(fd)).c_str(), path, sizeof path);
  return length <= 0 ? "" : std::string(path, static_cast<std::size_t>(length));
}

bool IsWatched(const std::string& path) { return !The().watched.empty() && path.rfind(The().watched + "/", 0) == 0; }

void Raw(const std::string& name, int flags, const char* bytes, std::size_t count) {
  static const auto write = Next<ssize_t (*)(int, const void*, size_t)>("write");
  const int fd = ::open((The().folder + "/" + name).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, 0600);
  if (fd < 0) std::abort();
  if (write(fd, bytes, count) != static_cast<ssize_t>(count)) std::abort();
  ::close(fd);
}

void Note(const std::string& line) { Raw("journal", O_APPEND, (line + "\n").c_str(), line.size() + 1); }

// The number of a copy of what the file holds now.
std::string CopyOf(int fd) {
  static int copies = 0;
  std::string bytes;
  char buffer[1 << 16];
  const int file = ::open(("/proc/self/fd/" + std::to_string(fd)).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return "-";
  for (ssize_t got = 0; (got = ::read(file, buffer, sizeof buffer)) > 0;)
    bytes.append(buffer, static_cast<std::size_t>(got));
  ::close(file);
  const std::string name = std::to_string(::getpid()) + "-" + std::to_string(++copies);
  Raw(name, O_TRUNC, bytes.data(), bytes.size());
  return name;
}

void Wrote(int fd) {
  const int error = errno;
  struct stat status {};
  if (::fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && IsWatched(PathOf(fd))) {
    const std::lock_guard lock(The().mutex);
    Note("write " + std::to_string(status.st_ino));
  }
  errno = error;
}

void Synced(int fd) {
  const int error = errno;
  struct stat status {};
  const std::string path = PathOf(fd);
  if (::fstat(fd, &status) == 0 && (IsWatched(path) || path == The().watched)) {
    const std::lock_guard lock(The().mutex);
    if (S_ISDIR(status.st_mode)) Note("names " + path);
    if (S_ISREG(status.st_mode)) Note("sync " + std::to_string(status.st_ino) + " " + CopyOf(fd));
  }
  errno = error;
}

}  // namespace

extern "C" ssize_t write(int fd, const void* bytes, size_t count) {
  static const auto next = Next<ssize_t (*)(int, const void*, size_t)>("write");
  const ssize_t wrote = next(fd, bytes, count);
  Wrote(fd);
  return wrote;
}
extern "C" ssize_t writev(int fd, const struct iovec* parts, int count) {
  static const auto next = Next<ssize_t (*)(int, const struct iovec*, int)>("writev");
  const ssize_t wrote = next(fd, parts, count);
  Wrote(fd);
  return wrote;
}
extern "C" ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t at) {
  static const auto next = Next<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
  const ssize_t wrote = next(fd, bytes, count, at);
  Wrote(fd);
  return wrote;
}
// What is written while a sync goes on may or may not be on the disk: the copy is of what was there before.
extern "C" int fsync(int fd) {
  static const auto next = Next<int (*)(int)>("fsync");
  Synced(fd);
  return next(fd);
}
extern "C" int fdatasync(int fd) {
  static const auto next = Next<int (*)(int)>("fdatasync");
  Synced(fd);
  return next(fd);
}
extern "C" int syncfs(int fd) {
  static const auto next = Next<int (*)(int)>("syncfs");
  if (IsWatched(PathOf(fd)) || PathOf(fd) == The().watched) {
    const std::lock_guard lock(The().mutex);
    Note("sync_all");
  }
  return next(fd);
}
namespace {
void Renamed(const char* from, const char* to) {
  struct stat status {};
  if (!IsWatched(from) || ::stat(from, &status) != 0) return;
  const std::lock_guard lock(The().mutex);
  Note("rename " + std::to_string(status.st_ino) + " " + from + " " + to);
}
}  // namespace
extern "C" int rename(const char* from, const char* to) {
  static const auto next = Next<int (*)(const char*, const char*)>("rename");
  Renamed(from, to);
  return next(from, to);
}
extern "C" int renameat2(int folder, const char* from, int other, const char* to, unsigned flags) {
  static const auto next = Next<int (*)(int, const char*, int, const char*, unsigned)>("renameat2");
  Renamed(from, to);
  return next(folder, from, other, to, flags);
}

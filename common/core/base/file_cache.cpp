// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/file_cache.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "common/core/base/mathematics.hpp"
#include "common/core/base/user_folders.hpp"

namespace rodeira::base {
namespace {

constexpr std::uint64_t kMagic = 0x31656863'61636472;  // "rdcache1"
constexpr std::size_t kHeader_bytes = 4 * sizeof(std::uint64_t);
constexpr std::string_view kEnding = ".cache", kPartEnding = ".part";
constexpr std::time_t kPartLives_s = 3600;  // of a file that a killed process has begun

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  bool ok() const { return number_ >= 0; }
  // Whether it is of this kind (S_IFDIR, S_IFREG), and only this user can have written there.
  bool IsOwn(mode_t kind, struct stat& status) const {
    return ok() && ::fstat(number_, &status) == 0 && (status.st_mode & S_IFMT) == kind &&
           status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  }

 private:
  int number_;
};

Descriptor OpenFolder(const std::filesystem::path& folder) {
  Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  return opened.IsOwn(S_IFDIR, status) ? std::move(opened) : Descriptor(-1);
}

std::string FileOf(Digest name) { return Hex(name) + std::string(kEnding); }

Bytes HeaderOf(Digest name, std::span<const std::byte> content) {
  ByteWriter header;
  header.Put(kMagic);
  header.Put(name);
  header.Put(static_cast<std::uint64_t>(content.size()));
  header.Put(Hash(content));
  return std::move(header.bytes());
}

bool WriteAll(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t wrote = ::write(file, bytes.data(), bytes.size());
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
  }
  return true;
}

bool ReadAll(int file, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t read = ::read(file, bytes.data(), bytes.size());
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(read));
  }
  return true;
}

struct Entry {
  std::int64_t used_s = 0, used_ns = 0;
  std::string file;
  std::uint64_t size = 0;
  auto operator<=>(const Entry&) const = default;
};

// All but half of the limit stays free behind it, so that the folder is not looked at with each file.
void Trim(const Descriptor& folder, std::uint64_t limit_bytes) {
  DIR* listed = ::fdopendir(::openat(folder.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (listed == nullptr) return;
  std::vector<Entry> entries;
  std::uint64_t all = 0;
  while (const dirent* entry = ::readdir(listed)) {
    const std::string_view file = entry->d_name;
    struct stat status {};
    if (!file.ends_with(kEnding) && !file.ends_with(kPartEnding)) continue;
    if (::fstatat(folder.number(), entry->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(status.st_mode))
      continue;
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (file.ends_with(kPartEnding)) {
      if (std::time(nullptr) - status.st_mtim.tv_sec > kPartLives_s)
        (void)::unlinkat(folder.number(), entry->d_name, 0);
      continue;
    }
    entries.push_back({status.st_mtim.tv_sec, status.st_mtim.tv_nsec, std::string(file), size});
    all += size;
  }
  ::closedir(listed);
  if (all <= limit_bytes) return;
  std::sort(entries.begin(), entries.end());
  for (const Entry& entry : entries) {
    if (all <= limit_bytes / 2) break;
    if (::unlinkat(folder.number(), entry.file.c_str(), 0) == 0) all -= entry.size;
  }
}

}  // namespace

FileCache::FileCache(std::filesystem::path folder, std::uint64_t limit_bytes, Digest build)
    : folder_(std::move(folder)),
      limit_bytes_(limit_bytes),
      build_(folder_.empty() ? build : Combine(build, MathLibraryFingerprint())),
      written_bytes_(limit_bytes) {}

Digest FileCache::NameOf(std::string_view kind, Digest source) const {
  return Combine(Combine(build_, Hash(kind)), source);
}

std::optional<Bytes> FileCache::Find(std::string_view kind, Digest source) {
  if (folder_.empty()) return std::nullopt;
  const Descriptor folder = OpenFolder(folder_);
  if (!folder.ok()) return std::nullopt;
  const Digest name = NameOf(kind, source);
  const Descriptor file(
      ::openat(folder.number(), FileOf(name).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!file.IsOwn(S_IFREG, status)) return std::nullopt;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size < kHeader_bytes || size > limit_bytes_) return std::nullopt;
  Bytes header(kHeader_bytes), content(size - kHeader_bytes);
  if (!ReadAll(file.number(), header) || !ReadAll(file.number(), content) || header != HeaderOf(name, content))
    return std::nullopt;
  (void)::futimens(file.number(), nullptr);
  return content;
}

void FileCache::Keep(std::string_view kind, Digest source, std::span<const std::byte> bytes) {
  if (folder_.empty() || kHeader_bytes + bytes.size() > limit_bytes_ / 4) return;
  std::error_code problem;
  std::filesystem::create_directories(folder_.parent_path(), problem);
  (void)::mkdir(folder_.c_str(), 0700);
  const Descriptor folder = OpenFolder(folder_);
  if (!folder.ok()) return;
  if (written_bytes_.fetch_add(bytes.size()) >= limit_bytes_ / 8) {
    written_bytes_ = 0;
    Trim(folder, limit_bytes_);
  }
  const Digest name = NameOf(kind, source);
  const std::string part = fmt::format("{}-{}-{}{}", Hex(name), ::getpid(), parts_++, kPartEnding);
  bool written = false;
  {
    const Descriptor file(
        ::openat(folder.number(), part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    if (!file.ok()) return;
    written = WriteAll(file.number(), HeaderOf(name, bytes)) && WriteAll(file.number(), bytes);
  }
  if (!written || ::renameat(folder.number(), part.c_str(), folder.number(), FileOf(name).c_str()) != 0)
    (void)::unlinkat(folder.number(), part.c_str(), 0);
}

FileCache& UserCache() {
  static FileCache cache(UserCacheFolder());
  return cache;
}

}  // namespace rodeira::base

// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/sink.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "common/core/base/open_error.hpp"
#include "common/core/base/put_in_place.hpp"
#include "common/data/record/background_sync.hpp"

namespace rodeira::record {
namespace {

base::Error CannotOpen(const std::filesystem::path& path, int error) {
  if (error == EEXIST)
    return base::WrongInput("file.exists", "the recording cannot be created: a file of that name is there already",
                            path.string());
  if (error == EWOULDBLOCK)
    return base::WrongInput("recording.in_use",
                            "the recording cannot be created: another process writes it at this moment", path.string());
  return base::OpenError("the recording cannot be created", error, path.string());
}

// Locks the file for this writer. Another process that asks whether it is locked holds it for some microseconds.
bool Lock(int file) {
  constexpr int kTries = 20;
  for (int i = 0; i < kTries; ++i) {
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK) return false;
    ::usleep(2000);
  }
  errno = EWOULDBLOCK;
  return false;
}

class FileSink final : public Sink {
 public:
  FileSink(int file, std::string path) : file_(file), path_(std::move(path)) {}
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;
  ~FileSink() override {
    sync_.reset();
    if (file_ >= 0) ::close(file_);
  }

  base::Status Append(std::span<const std::byte> bytes) override {
    RODEIRA_ASSERT(file_ >= 0);
    if (const int problem = SyncProblem(); problem != 0) return Problem("brought to the disk", problem);
    while (!bytes.empty()) {
      const ssize_t wrote = ::write(file_, bytes.data(), bytes.size());
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote <= 0) return Problem("written", wrote < 0 ? errno : ENOSPC);
      bytes = bytes.subspan(static_cast<std::size_t>(wrote));
    }
    return {};
  }

  base::Status Sync() override {
    RODEIRA_ASSERT(file_ >= 0);
    // What is no file (a pipe, a device) has nothing to wait for and says EINVAL; some file systems say EROFS.
    if (::fdatasync(file_) != 0 && errno != EINVAL && errno != EROFS) return Problem("brought to the disk", errno);
    return {};
  }

  void SyncSoon() override {
    RODEIRA_ASSERT(file_ >= 0);
    if (!sync_ && !has_no_thread_) {
      try {
        sync_ = std::make_unique<BackgroundSync>(file_, path_);
      } catch (const std::system_error&) {
        has_no_thread_ = true;  // the machine has none left: the writer waits for the disk itself
        base::SyncName(path_);
      }
    }
    if (sync_) {
      sync_->Request();
    } else if (const base::Status synced = Sync(); !synced && sync_problem_ == 0) {
      sync_problem_ = EIO;
    }
  }

  void CutTo(std::uint64_t size) override {
    // Best effort: where it fails, the reader passes over the incomplete record all the same.
    if (::ftruncate(file_, static_cast<off_t>(size)) == 0) ::lseek(file_, static_cast<off_t>(size), SEEK_SET);
  }

  base::Status Close() override {
    if (file_ < 0) return {};
    const int earlier = SyncProblem();
    sync_.reset();
    base::Status synced = earlier == 0 ? Sync() : Problem("brought to the disk", earlier);
    base::SyncName(path_);
    const int result = ::close(std::exchange(file_, -1));
    const int error = errno;
    if (!synced) return synced;
    if (result != 0 && error != EINTR) return Problem("closed", error);
    return {};
  }

  std::string name() const override { return path_; }

 private:
  // errno of an earlier SyncSoon that failed; 0: none has.
  int SyncProblem() const { return sync_ ? sync_->error() : sync_problem_; }
  base::Error Problem(const char* what, int error) const {
    return base::Failed("recording.cannot_write",
                        fmt::format("the recording cannot be {}: {}", what, std::strerror(error)), path_);
  }

  int file_;
  std::string path_;
  std::unique_ptr<BackgroundSync> sync_;  // where it was asked for
  bool has_no_thread_ = false;
  int sync_problem_ = 0;
};

}  // namespace

base::Result<std::unique_ptr<Sink>> OpenFileSink(const std::filesystem::path& path, bool overwrite) {
  struct stat before {};
  const bool there = ::stat(path.c_str(), &before) == 0;
  const bool device = there && !S_ISREG(before.st_mode);  // a pipe or device is written, not replaced
  const int how = O_WRONLY | O_CLOEXEC | O_CREAT | (overwrite || device ? 0 : O_EXCL);
  const int file = ::open(path.c_str(), how, 0666);
  if (file < 0) return CannotOpen(path, errno);
  auto sink = std::make_unique<FileSink>(file, path.string());
  if (device) return std::unique_ptr<Sink>(std::move(sink));
  if (!Lock(file)) return CannotOpen(path, errno);
  if (there && ::ftruncate(file, 0) != 0) return CannotOpen(path, errno);
  return std::unique_ptr<Sink>(std::move(sink));
}

base::Result<std::unique_ptr<Sink>> OpenFileSinkBehind(const std::filesystem::path& path, std::uint64_t size) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return CannotOpen(path, errno);
  auto sink = std::make_unique<FileSink>(file, path.string());
  if (!Lock(file)) return CannotOpen(path, errno);
  if (::ftruncate(file, static_cast<off_t>(size)) != 0 || ::lseek(file, 0, SEEK_END) < 0)
    return CannotOpen(path, errno);
  return std::unique_ptr<Sink>(std::move(sink));
}

bool IsBeingWritten(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool locked = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);
  return locked;
}

base::Status MemorySink::Append(std::span<const std::byte> bytes) {
  const std::uint64_t room = capacity_ > into_->size() ? capacity_ - into_->size() : 0;
  const auto fits = bytes.first(static_cast<std::size_t>(std::min<std::uint64_t>(room, bytes.size())));
  into_->insert(into_->end(), fits.begin(), fits.end());
  if (fits.size() < bytes.size()) {
    return base::Failed("recording.cannot_write",
                        fmt::format("the recording cannot be written: the room of {} bytes is full", capacity_),
                        name());
  }
  return {};
}

void MemorySink::CutTo(std::uint64_t size) {
  if (size < into_->size()) into_->resize(static_cast<std::size_t>(size));
}

}  // namespace rodeira::record

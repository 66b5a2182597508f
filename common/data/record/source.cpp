// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/core/base/nearest_file.hpp"
#include "common/core/base/open_error.hpp"

namespace rodeira::record {
namespace {

class FileSource final : public Source {
 public:
  FileSource(int file, std::string name, std::uint64_t size) : Source(std::move(name), size), file_(file) {}
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  ~FileSource() override { ::close(file_); }

 private:
  base::Status Fill(std::uint64_t offset, std::span<std::byte> into) const override {
    while (!into.empty()) {
      const ssize_t got = ::pread(file_, into.data(), into.size(), static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) {
        return base::Failed("file.cannot_read",
                            fmt::format("the file cannot be read at byte {}: {}", offset, std::strerror(errno)),
                            name());
      }
      if (got == 0)
        return base::Failed("file.cannot_read", fmt::format("the file became shorter than {} bytes meanwhile", size()),
                            name());
      offset += static_cast<std::uint64_t>(got);
      into = into.subspan(static_cast<std::size_t>(got));
    }
    return {};
  }

  int file_;
};

class Memory final : public Source {
 public:
  explicit Memory(base::Bytes bytes) : Source("memory", bytes.size()), bytes_(std::move(bytes)) {}

 private:
  base::Status Fill(std::uint64_t offset, std::span<std::byte> into) const override {
    std::memcpy(into.data(), bytes_.data() + offset, into.size());
    return {};
  }

  base::Bytes bytes_;
};

}  // namespace

base::Result<base::Bytes> Source::Read(std::uint64_t offset, std::uint64_t size) const {
  RODEIRA_ASSERT(offset <= size_ && size <= size_ - offset);
  base::Bytes bytes(static_cast<std::size_t>(size));
  if (bytes.empty()) return bytes;
  if (auto status = Fill(offset, bytes); !status) return status.error();
  return bytes;
}

base::Result<std::unique_ptr<Source>> OpenFileSource(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int problem = errno;
  if (file < 0 && (problem == ENOENT || problem == ENOTDIR))
    return base::WrongInput("file.not_found", base::NoSuchFile(path), path.string());
  if (file < 0) return base::OpenError("the recording cannot be opened", problem, path.string());
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(file);
    return base::WrongInput("file.not_regular", "this is not a file, a recording was expected", path.string());
  }
  return std::unique_ptr<Source>(
      std::make_unique<FileSource>(file, path.string(), static_cast<std::uint64_t>(status.st_size)));
}

std::unique_ptr<Source> MemorySource(base::Bytes bytes) { return std::make_unique<Memory>(std::move(bytes)); }

}  // namespace rodeira::record

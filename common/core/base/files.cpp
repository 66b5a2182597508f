// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "common/core/base/nearest_file.hpp"
#include "common/core/base/open_error.hpp"
#include "common/core/base/put_in_place.hpp"

namespace rodeira::base {
namespace {

// What has no size before it is read: a pipe, a shell's <(…).
template <class Buffer>
Result<Buffer> ReadStream(std::ifstream& in, const std::filesystem::path& path, std::size_t limit_bytes) {
  constexpr std::size_t kChunk = 1 << 16;
  Buffer buffer;
  while (in) {
    const std::size_t held = buffer.size();
    buffer.resize(held + kChunk);
    in.read(reinterpret_cast<char*>(buffer.data() + held), kChunk);
    buffer.resize(held + static_cast<std::size_t>(in.gcount()));
    if (buffer.size() > limit_bytes)
      return WrongInput("file.too_large",
                        fmt::format("more than the {} bytes that were expected at most came", limit_bytes),
                        path.string());
  }
  if (in.bad()) return Failed("file.cannot_read", "the file cannot be read to its end", path.string());
  return buffer;
}

template <class Buffer>
Result<Buffer> ReadInto(const std::filesystem::path& path, std::size_t limit_bytes) {
  std::error_code problem;
  const auto status = std::filesystem::status(path, problem);
  if (!std::filesystem::exists(status)) return WrongInput("file.not_found", NoSuchFile(path), path.string());
  if (std::filesystem::is_directory(status))
    return WrongInput("file.is_folder", "this is a folder, a file was expected", path.string());
  std::ifstream in(path, std::ios::binary);
  if (!in) return OpenError("the file cannot be opened", errno, path.string());
  if (!std::filesystem::is_regular_file(status)) return ReadStream<Buffer>(in, path, limit_bytes);
  const auto size = static_cast<std::size_t>(in.seekg(0, std::ios::end).tellg());
  if (size > limit_bytes) {
    return WrongInput("file.too_large",
                      fmt::format("the file has {} bytes, at most {} were expected", size, limit_bytes), path.string());
  }
  Buffer buffer(size, {});
  in.seekg(0);
  if (size > 0 && !in.read(reinterpret_cast<char*>(buffer.data()), static_cast<std::streamsize>(size))) {
    return Failed("file.cannot_read", "the file cannot be read to its end", path.string());
  }
  return buffer;
}

}  // namespace

Result<std::string> ReadText(const std::filesystem::path& path, std::size_t limit_bytes) {
  return ReadInto<std::string>(path, limit_bytes);
}

Result<Bytes> ReadBytes(const std::filesystem::path& path, std::size_t limit_bytes) {
  return ReadInto<Bytes>(path, limit_bytes);
}

Status WriteWhole(const std::filesystem::path& path, std::span<const std::byte> bytes, Durable durable) {
  std::error_code problem;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), problem);
  const std::filesystem::path beside = path.string() + fmt::format(".{}.part", ::getpid());
  const auto fail = [&](std::string_view what) {
    Error error = Failed("file.cannot_write", fmt::format("the file cannot be {}: {}", what, std::strerror(errno)),
                         path.string());
    std::filesystem::remove(beside, problem);
    return error;
  };
  const int file = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return fail("created");
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t wrote = ::write(file, bytes.data() + done, bytes.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) {
      ::close(file);
      return fail("written");
    }
    done += static_cast<std::size_t>(wrote);
  }
  // Some file systems cannot sync (EINVAL, EROFS): they promise nothing, and that is no error of the file.
  if (durable == Durable::kNow && ::fsync(file) != 0 && errno != EINVAL && errno != EROFS) {
    const int error = errno;
    ::close(file);
    errno = error;
    return fail("written");
  }
  if (::close(file) != 0) return fail("closed");
  if (::rename(beside.c_str(), path.c_str()) != 0) return fail("put in its place");
  if (durable == Durable::kNow) SyncName(path);
  return {};
}

Status SyncFolder(const std::filesystem::path& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool done = opened >= 0 && ::syncfs(opened) == 0;
  const int error = errno;
  if (opened >= 0) ::close(opened);
  if (done) return {};
  return Failed("file.cannot_write", fmt::format("the folder cannot be written to the disk: {}", std::strerror(error)),
                folder.string());
}

Status WriteWhole(const std::filesystem::path& path, std::string_view text) {
  return WriteWhole(path, std::as_bytes(std::span(text)));
}

}  // namespace rodeira::base

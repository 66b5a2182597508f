// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/csv_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "common/core/base/append_format.hpp"
#include "common/core/base/csv_cell.hpp"

namespace rodeira::csv {
namespace {

constexpr std::size_t kBufferBytes = 1u << 20;

}  // namespace

base::Result<CsvFile> CsvFile::Create(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0)
    return base::Failed("table.cannot_write", fmt::format("the table cannot be created: {}", std::strerror(errno)),
                        path.string());
  return CsvFile(file, path);
}

CsvFile::CsvFile(CsvFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      path_(std::move(other.path_)),
      buffer_(std::move(other.buffer_)),
      written_(other.written_) {}

CsvFile::~CsvFile() {
  if (file_ >= 0) ::close(file_);
}

base::Status CsvFile::Drain() { return buffer_.size() < kBufferBytes ? base::Status() : WriteOut(); }

base::Status CsvFile::WriteOut() {
  std::string_view left = buffer_;
  while (!left.empty()) {
    const ssize_t wrote = ::write(file_, left.data(), left.size());
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) {
      const char* why = std::strerror(wrote < 0 ? errno : ENOSPC);
      return base::Failed("table.cannot_write", fmt::format("the table cannot be written: {}", why), path_.string());
    }
    left.remove_prefix(static_cast<std::size_t>(wrote));
  }
  written_ += buffer_.size();
  buffer_.clear();
  return {};
}

base::Status CsvFile::Close() {
  if (auto status = WriteOut(); !status) return status;
  if (::close(std::exchange(file_, -1)) != 0 && errno != EINTR) {
    return base::Failed("table.cannot_write", fmt::format("the table cannot be closed: {}", std::strerror(errno)),
                        path_.string());
  }
  return {};
}

void AppendCell(std::string_view text, std::string& out) { out += base::CsvCell(text); }

void AppendSeconds(std::int64_t time_ns, std::string& out) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  const std::uint64_t size =
      time_ns < 0 ? 0 - static_cast<std::uint64_t>(time_ns) : static_cast<std::uint64_t>(time_ns);
  if (time_ns < 0) out += '-';
  base::AppendFormat(out, "{}", size / kSecond);
  if (size % kSecond == 0) return;
  base::AppendFormat(out, ".{:09}", size % kSecond);
  while (out.back() == '0') out.pop_back();
}

}  // namespace rodeira::csv

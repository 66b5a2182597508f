// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/spilled_column.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/data/csv/mat_file.hpp"

namespace rodeira::csv {
namespace {

base::Error CannotWrite(const std::filesystem::path& folder) {
  return base::Failed("table.cannot_write",
                      fmt::format("parts of a table cannot be kept in the folder: {}", std::strerror(errno)),
                      folder.string());
}

template <class Value>
std::string_view BytesOf(const Value& value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

}  // namespace

base::Result<SpillFile> SpillFile::Create(const std::filesystem::path& folder) {
  std::string name = (folder / "partsXXXXXX").string();
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) return CannotWrite(folder);
  ::unlink(name.c_str());
  return SpillFile(file, folder);
}

SpillFile::SpillFile(SpillFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)), folder_(std::move(other.folder_)), size_(other.size_) {}

SpillFile::~SpillFile() {
  if (file_ >= 0) ::close(file_);
}

base::Result<SpillFile::Piece> SpillFile::Append(std::string_view data) {
  const Piece piece{size_, data.size()};
  while (!data.empty()) {
    const ssize_t wrote = ::pwrite(file_, data.data(), data.size(), static_cast<off_t>(size_));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote == 0) errno = ENOSPC;
    if (wrote <= 0) return CannotWrite(folder_);
    size_ += static_cast<std::uint64_t>(wrote);
    data.remove_prefix(static_cast<std::size_t>(wrote));
  }
  return piece;
}

base::Status SpillFile::Read(const Piece& piece, std::string& out) const {
  const std::size_t begin = out.size();
  out.resize(begin + piece.bytes);
  for (std::uint64_t done = 0; done < piece.bytes;) {
    const ssize_t got =
        ::pread(file_, out.data() + begin + done, piece.bytes - done, static_cast<off_t>(piece.offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      const char* why = got < 0 ? std::strerror(errno) : "the file is shorter than it was";
      return base::Failed("table.cannot_read_back", fmt::format("parts of a table cannot be read back: {}", why),
                          folder_.string());
    }
    done += static_cast<std::uint64_t>(got);
  }
  return {};
}

base::Status SpilledColumn::Spill(SpillFile& spill) {
  if (newest_.size() < kPartBytes) return {};
  const auto piece = spill.Append(newest_);
  if (!piece) return piece.error();
  pieces_.push_back(piece.value());
  spilled_ += newest_.size();
  newest_.clear();
  return {};
}

base::Status SpilledColumn::Add(double value, SpillFile& spill) {
  RODEIRA_ASSERT(kind_ == Kind::kNumbers);
  ++rows_;
  newest_ += BytesOf(value);
  return Spill(spill);
}

base::Status SpilledColumn::Add(std::uint64_t value, SpillFile& spill) {
  RODEIRA_ASSERT(kind_ == Kind::kWhole);
  ++rows_;
  newest_ += BytesOf(value);
  return Spill(spill);
}

base::Status SpilledColumn::AddElement(std::string_view text, SpillFile& spill) {
  AppendMatText(newest_, text);
  return Spill(spill);
}

base::Status SpilledColumn::Add(std::string_view text, SpillFile& spill) {
  RODEIRA_ASSERT(kind_ == Kind::kTexts);
  if (rows_++ == 0) first_ = text;
  if (is_one_ && text == first_) return {};
  if (std::exchange(is_one_, false)) {  // the rows before, which had the one text
    for (std::uint64_t row = 1; row < rows_; ++row) {
      if (auto status = AddElement(first_, spill); !status) return status;
    }
  }
  return AddElement(text, spill);
}

std::size_t SpilledColumn::bytes_in_memory() const {
  return name_.capacity() + newest_.capacity() + first_.capacity() + pieces_.capacity() * sizeof(SpillFile::Piece);
}

}  // namespace rodeira::csv

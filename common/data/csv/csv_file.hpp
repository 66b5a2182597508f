// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "common/core/base/result.hpp"

namespace rodeira::csv {

// A text file that is written from its beginning to its end.
class CsvFile {
 public:
  // Failed where it cannot be created.
  static base::Result<CsvFile> Create(const std::filesystem::path& path);
  CsvFile(CsvFile&& other) noexcept;
  CsvFile& operator=(CsvFile&&) = delete;
  ~CsvFile();

  // To write into; Drain() empties it where it has grown.
  std::string& buffer() { return buffer_; }
  // Drain and Close fail where the disk refuses.
  base::Status Drain();
  // Everything is with the operating system.
  base::Status Close();
  std::uint64_t written_bytes() const { return written_; }

 private:
  CsvFile(int file, std::filesystem::path path) : file_(file), path_(std::move(path)) {}
  base::Status WriteOut();

  int file_;
  std::filesystem::path path_;
  std::string buffer_;
  std::uint64_t written_ = 0;
};

// The text as one cell (RFC 4180): in quotes, with doubled quotes inside, where it holds a quote, comma or line break.
void AppendCell(std::string_view text, std::string& out);
// Nanoseconds as a decimal number of seconds without rounding: 1500000000 is "1.5", -1 is "-0.000000001".
void AppendSeconds(std::int64_t time_ns, std::string& out);

}  // namespace rodeira::csv

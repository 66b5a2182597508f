// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"

// Files that are packed: gzip (.xodr.gz, ASAM's .xodrz) and ZIP. Everything is unpacked in memory; nothing is written.
namespace rodeira::opendrive {

inline constexpr std::size_t kMaxUnpackedBytes = std::size_t{1} << 29;

// By the first bytes alone: whether the rest is sound, Gunzip and Archive::Open find out.
bool IsGzip(std::string_view bytes);
bool IsZip(std::string_view bytes);

inline constexpr std::size_t kMaxPackedRatio = 250;  // numbers in XML are packed by 5 to 40 times
// Whether data of so many bytes, of which so much is unpacked by now, is no file of roads but made to fill a memory or
// a disk: from 16 MiB on more than kMaxPackedRatio times what is packed.
bool IsBomb(std::size_t unpacked, std::size_t packed);

// What is unpacked is bounded by kMaxUnpackedBytes and, from 16 MiB on, by 250 times what is packed. Wrong input beyond
// these bounds and where the data is damaged or cut short.
base::Result<std::string> Gunzip(std::string_view bytes, const std::filesystem::path& path);

// A ZIP archive in memory. For one thread at a time.
class Archive {
 public:
  // Wrong input where it is damaged, encrypted, holds more than 10 000 files, or a name in it leads out of it.
  static base::Result<std::shared_ptr<const Archive>> Open(std::string bytes, const std::filesystem::path& path);

  // Of its files, with '/' between folders; what the Finder of macOS adds is left out.
  const std::vector<std::string>& names() const { return names_; }
  // Whether names() has it.
  bool Has(const std::string& name) const;
  // A file of names(), bounded as for Gunzip.
  base::Result<std::string> Read(const std::string& name) const;

 private:
  Archive() = default;
  std::string bytes_;
  std::filesystem::path path_;
  std::vector<std::string> names_, stored_;  // as asked for, and as they stand in the archive
};

}  // namespace rodeira::opendrive

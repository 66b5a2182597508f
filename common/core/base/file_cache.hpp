// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "common/core/base/build_id.hpp"
#include "common/core/base/bytes.hpp"
#include "common/core/base/hash.hpp"

namespace rodeira::base {

// A folder with files that hold results which can be computed again, by the digest of what they were computed from.
// Any number of threads and processes use it at once. It never fails: what cannot be read is computed again, what
// cannot be written is not kept. Files are written beside and renamed, and checked when they are read. A folder that
// is a link, belongs to another user, or can be written by other users is not used; neither is such a file.
class FileCache {
 public:
  static constexpr std::uint64_t kLimit_bytes = std::uint64_t{1} << 30;

  // An empty path: nothing is kept. `build`: results of one build are not found by another one.
  explicit FileCache(std::filesystem::path folder, std::uint64_t limit_bytes = kLimit_bytes,
                     Digest build = BuildDigest());

  // The result of this kind from these sources; nothing where it is not there as it was written.
  std::optional<Bytes> Find(std::string_view kind, Digest source);
  // Files that were not used for longest are removed where all files of the folder are larger than the limit.
  void Keep(std::string_view kind, Digest source, std::span<const std::byte> bytes);

  bool is_used() const { return !folder_.empty(); }

 private:
  Digest NameOf(std::string_view kind, Digest source) const;

  std::filesystem::path folder_;
  std::uint64_t limit_bytes_;
  Digest build_;                                // and the mathematics library
  std::atomic<std::uint64_t> written_bytes_{};  // since the folder's size was looked at
  std::atomic<std::uint64_t> parts_{};
};

// The cache in UserCacheFolder(), one for the process.
FileCache& UserCache();

}  // namespace rodeira::base

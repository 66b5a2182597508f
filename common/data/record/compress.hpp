// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"

struct ZSTD_CCtx_s;

namespace rodeira::record {

// Appends zstd frames to a buffer. Throws std::bad_alloc where zstd gets no memory. The same bytes, level and library
// version give the same frame.
class ZstdCompressor {
 public:
  explicit ZstdCompressor(int level);
  // Appends one frame that holds `bytes` to `out`; returns its size.
  std::uint64_t Append(std::span<const std::byte> bytes, base::Bytes& out);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
};

// One whole zstd frame that must hold exactly `size` bytes. Memory is asked for only after the frame's own header and
// length have been found to fit that size. The Error says what was found;
// std::bad_alloc where zstd gets no memory.
base::Result<base::Bytes> ZstdDecompress(std::span<const std::byte> frame, std::uint64_t size);

// The same for lz4 frames (not blocks), which other programs write.
base::Result<base::Bytes> Lz4Decompress(std::span<const std::byte> frame, std::uint64_t size);

}  // namespace rodeira::record

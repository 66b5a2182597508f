// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/compress.hpp"

#include <fmt/format.h>
#include <zstd.h>

namespace rodeira::record {
namespace {

// A zstd block has at least four bytes and holds at most 128 KiB (RFC 8878, 3.1.1.2).
constexpr std::uint64_t kMaxBlockBytes = 128u << 10;
constexpr std::uint64_t kMinBlockBytes = 4;

}  // namespace

void ZstdCompressor::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

ZstdCompressor::ZstdCompressor(int level) : context_(ZSTD_createCCtx()) {
  RODEIRA_ASSERT(context_ != nullptr);
  RODEIRA_ASSERT(!ZSTD_isError(ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, level)));
}

std::uint64_t ZstdCompressor::Append(std::span<const std::byte> bytes, base::Bytes& out) {
  const std::size_t before = out.size();
  out.resize(before + ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress2(context_.get(), out.data() + before, out.size() - before, bytes.data(), bytes.size());
  RODEIRA_ASSERT(!ZSTD_isError(size));  // the bound holds, so only lack of memory could fail here
  out.resize(before + size);
  return size;
}

base::Result<base::Bytes> ZstdDecompress(std::span<const std::byte> frame, std::uint64_t size) {
  const unsigned long long declared = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (declared == ZSTD_CONTENTSIZE_ERROR) return base::WrongInput("its zstd frame has no valid header");
  if (declared != ZSTD_CONTENTSIZE_UNKNOWN && declared != size) {
    return base::WrongInput(fmt::format("its zstd frame holds {} bytes, {} were expected", declared, size));
  }
  if (size > (frame.size() / kMinBlockBytes + 1) * kMaxBlockBytes) {
    return base::WrongInput(fmt::format("{} compressed bytes cannot hold {} bytes", frame.size(), size));
  }
  base::Bytes bytes(size);
  const std::size_t got = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size());
  if (ZSTD_isError(got)) return base::WrongInput(fmt::format("zstd says '{}'", ZSTD_getErrorName(got)));
  if (got != size) return base::WrongInput(fmt::format("it holds {} bytes, {} were expected", got, size));
  return bytes;
}

}  // namespace rodeira::record

// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/compress.hpp"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <new>
#include <string_view>

namespace rodeira::record {
namespace {

// A zstd block has at least four bytes and holds at most 128 KiB (RFC 8878, 3.1.1.2).
constexpr std::uint64_t kMaxBlockBytes = 128u << 10;
constexpr std::uint64_t kMinBlockBytes = 4;
// One byte of an lz4 block lengthens a match by at most 255 bytes (lz4_Block_format.md).
constexpr std::uint64_t kMaxLz4Ratio = 255;

struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

// Lack of memory is told as by `new`: it says nothing about the bytes.
void ThrowIfNoMemory(std::size_t zstd_result) {
  if (ZSTD_getErrorCode(zstd_result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
}
void ThrowIfNoMemoryOfLz4(LZ4F_errorCode_t result) {
  // The numbers of lz4's errors are not in its stable interface.
  if (LZ4F_isError(result) && std::string_view(LZ4F_getErrorName(result)) == "ERROR_allocation_failed")
    throw std::bad_alloc();
}

}  // namespace

void ZstdCompressor::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

ZstdCompressor::ZstdCompressor(int level) : context_(ZSTD_createCCtx()) {
  if (context_ == nullptr) throw std::bad_alloc();
  RODEIRA_ASSERT(!ZSTD_isError(ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, level)));
}

std::uint64_t ZstdCompressor::Append(std::span<const std::byte> bytes, base::Bytes& out) {
  const std::size_t before = out.size();
  out.resize(before + ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress2(context_.get(), out.data() + before, out.size() - before, bytes.data(), bytes.size());
  ThrowIfNoMemory(size);
  RODEIRA_ASSERT(!ZSTD_isError(size));  // the bound holds
  out.resize(before + size);
  return size;
}

base::Result<base::Bytes> ZstdDecompress(std::span<const std::byte> frame, std::uint64_t size) {
  const unsigned long long declared = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (declared == ZSTD_CONTENTSIZE_ERROR)
    return base::WrongInput("recording.wrong_compression", "its zstd frame has no valid header");
  if (declared != ZSTD_CONTENTSIZE_UNKNOWN && declared != size) {
    return base::WrongInput("recording.wrong_compression",
                            fmt::format("its zstd frame holds {} bytes, {} were expected", declared, size));
  }
  if (size > (frame.size() / kMinBlockBytes + 1) * kMaxBlockBytes) {
    return base::WrongInput("recording.wrong_compression",
                            fmt::format("{} compressed bytes cannot hold {} bytes", frame.size(), size));
  }
  base::Bytes bytes(size);
  const std::size_t got = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size());
  ThrowIfNoMemory(got);
  if (ZSTD_isError(got))
    return base::WrongInput("recording.wrong_compression", fmt::format("zstd says '{}'", ZSTD_getErrorName(got)));
  if (got != size)
    return base::WrongInput("recording.wrong_compression",
                            fmt::format("it holds {} bytes, {} were expected", got, size));
  return bytes;
}

base::Result<base::Bytes> Lz4Decompress(std::span<const std::byte> frame, std::uint64_t size) {
  if (size / kMaxLz4Ratio > frame.size()) {
    return base::WrongInput("recording.wrong_compression",
                            fmt::format("{} compressed bytes cannot hold {} bytes", frame.size(), size));
  }
  LZ4F_dctx* made = nullptr;
  const LZ4F_errorCode_t making = LZ4F_createDecompressionContext(&made, LZ4F_VERSION);
  ThrowIfNoMemoryOfLz4(making);
  RODEIRA_ASSERT(!LZ4F_isError(making));
  const std::unique_ptr<LZ4F_dctx, FreeLz4> context(made);
  base::Bytes bytes(static_cast<std::size_t>(size) + 1);  // one byte more: a frame that holds more is noticed
  std::size_t read = 0;
  std::size_t written = 0;
  std::size_t expected = 1;  // bytes that the frame still needs
  while (read < frame.size()) {
    std::size_t in = frame.size() - read;
    std::size_t out = bytes.size() - written;
    expected = LZ4F_decompress(context.get(), bytes.data() + written, &out, frame.data() + read, &in, nullptr);
    ThrowIfNoMemoryOfLz4(expected);
    if (LZ4F_isError(expected))
      return base::WrongInput("recording.wrong_compression", fmt::format("lz4 says '{}'", LZ4F_getErrorName(expected)));
    read += in;
    written += out;
    if (in == 0 && out == 0) break;
  }
  if (written > size)
    return base::WrongInput("recording.wrong_compression",
                            fmt::format("it holds more than the {} bytes that were expected", size));
  if (expected != 0) return base::WrongInput("recording.wrong_compression", "its lz4 frame is incomplete");
  if (written < size)
    return base::WrongInput("recording.wrong_compression",
                            fmt::format("it holds {} bytes, {} were expected", written, size));
  bytes.pop_back();
  return bytes;
}

}  // namespace rodeira::record

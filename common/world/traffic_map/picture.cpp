// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/picture.hpp"

#include <cstddef>
#include <cstdint>

namespace rodeira::traffic_map {
namespace {

// Big-endian; the caller has seen that the bytes are there.
std::uint32_t Number(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// Deflate makes no more than 1032 bytes of one: 258 of two bits.
constexpr std::uint64_t kMaxOfByte = 1032;

bool PngFits(std::string_view bytes, std::uint64_t width, std::uint64_t height) {
  if (bytes.size() < 26) return false;
  const std::uint64_t bits = Number(bytes, 24, 1), kind = Number(bytes, 25, 1);
  const std::uint64_t channels = kind == 2 ? 3 : kind == 4 ? 2 : kind == 6 ? 4 : 1;
  return bytes.size() * kMaxOfByte >= height * (1 + (width * bits * channels + 7) / 8);
}

// Huffman's code has at least one bit for each block of 8 by 8 pixels; arithmetic coding, from C9 on, may have less.
bool JpegFits(std::string_view bytes, std::uint64_t width, std::uint64_t height, std::uint32_t code) {
  return code > 0xC8 || 8 * bytes.size() >= (width + 7) / 8 * ((height + 7) / 8);
}

std::optional<PictureInfo> Sized(std::string_view kind, std::uint32_t width, std::uint32_t height, bool fits,
                                 bool ends) {
  constexpr std::uint32_t kMost = 0x7FFFFFFF;
  if (width == 0 || height == 0 || width > kMost || height > kMost) return std::nullopt;
  return PictureInfo{kind, static_cast<int>(width), static_cast<int>(height), fits, ends};
}

// Segments one after the other up to the frame header SOF0 to SOF15; C4, C8 and CC among those codes are other
// segments.
std::optional<PictureInfo> ReadJpeg(std::string_view bytes) {
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (Number(bytes, at, 1) != 0xFF) return std::nullopt;
    const std::uint32_t code = Number(bytes, at + 1, 1);
    if (code == 0xFF) {  // fill
      ++at;
      continue;
    }
    if (code >= 0xC0 && code <= 0xCF && code != 0xC4 && code != 0xC8 && code != 0xCC) {
      if (at + 9 > bytes.size()) return std::nullopt;
      const std::uint32_t width = Number(bytes, at + 7, 2), height = Number(bytes, at + 5, 2);
      return Sized("JPEG", width, height, JpegFits(bytes, width, height, code),
                   bytes.find("\xff\xd9", at + 9) != std::string_view::npos);
    }
    if (code == 0xD9 || code == 0xDA) return std::nullopt;
    const std::uint32_t length = Number(bytes, at + 2, 2);
    if (length < 2) return std::nullopt;
    at += 2 + length;
  }
  return std::nullopt;
}

}  // namespace

std::optional<PictureInfo> ReadPictureInfo(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR"sv)) {
    if (bytes.size() < 24) return std::nullopt;
    const std::uint32_t width = Number(bytes, 16, 4), height = Number(bytes, 20, 4);
    return Sized("PNG", width, height, PngFits(bytes, width, height),
                 bytes.find("IEND\xae\x42\x60\x82"sv, 24) != std::string_view::npos);
  }
  if (bytes.starts_with("\xff\xd8\xff"sv)) return ReadJpeg(bytes);
  return std::nullopt;
}

}  // namespace rodeira::traffic_map

// SPDX-License-Identifier: Apache-2.0
#include "tests/common/data/record/mutated.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

#include "common/data/record/checksum.hpp"

namespace rodeira::record {
namespace {

// A length or an offset that looks plausible, or is at an edge.
std::uint64_t Interesting(Draw& draw, std::uint64_t size) {
  const std::uint64_t values[] = {0,
                                  1,
                                  7,
                                  9,
                                  size,
                                  size - 1,
                                  size + 1,
                                  0x7F,
                                  0x80,
                                  0xFF,
                                  0xFFFF,
                                  0x7FFFFFFF,
                                  0xFFFFFFFF,
                                  0x10000000,
                                  0x10000001,
                                  0x7FFFFFFFFFFFFFFF,
                                  ~0ull,
                                  ~0ull - 8,
                                  draw.Bits() % (size + 1)};
  return values[draw.Below(std::size(values))];
}

void MutateAt(base::Bytes& bytes, std::size_t at, Draw& draw) {
  const std::size_t left = bytes.size() - at;
  const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto length = static_cast<std::ptrdiff_t>(1 + draw.Below(std::min<std::size_t>(left, 64)));
  switch (draw.Below(8)) {
    case 0:
      bytes[at] ^= static_cast<std::byte>(1u << draw.Below(8));
      break;
    case 1:
      bytes[at] = static_cast<std::byte>(draw.Bits());
      break;
    case 2:
    case 3: {
      const std::uint64_t value = Interesting(draw, bytes.size());
      std::memcpy(bytes.data() + at, &value, std::min<std::size_t>(left, draw.Below(2) == 0 ? 4 : 8));
      break;
    }
    case 4:
      bytes.erase(place, place + std::min<std::ptrdiff_t>(length, static_cast<std::ptrdiff_t>(left)));
      break;
    case 5: {
      const base::Bytes copy(place, place + std::min<std::ptrdiff_t>(length, static_cast<std::ptrdiff_t>(left)));
      const auto target = bytes.begin() + static_cast<std::ptrdiff_t>(draw.Below(bytes.size()));
      bytes.insert(target, copy.begin(), copy.end());
      break;
    }
    case 6:
      bytes.resize(at);
      break;
    default:
      std::fill(place, place + std::min<std::ptrdiff_t>(length, static_cast<std::ptrdiff_t>(left)), std::byte{0});
  }
}

void PutCrc(base::Bytes& bytes, std::size_t from, std::size_t to, std::size_t at) {
  const std::uint32_t crc = Crc32(std::span(bytes).subspan(from, to - from));
  std::memcpy(bytes.data() + at, &crc, sizeof crc);
}

std::uint64_t NumberAt(const base::Bytes& bytes, std::size_t at) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

}  // namespace

void Mutate(base::Bytes& bytes, Draw& draw) { MutateAt(bytes, draw.Below(bytes.size()), draw); }

void MutateARecord(base::Bytes& bytes, Draw& draw) {
  std::vector<std::size_t> starts;
  for (std::size_t at = 8; at + 9 < bytes.size();) {
    starts.push_back(at);
    const std::uint64_t length = NumberAt(bytes, at + 1);
    if (length > bytes.size() - at - 9) break;
    at += 9 + static_cast<std::size_t>(length);
  }
  const std::size_t start = starts.empty() ? 0 : starts[draw.Below(starts.size())];
  MutateAt(bytes, std::min(start + draw.Below(100), bytes.size() - 1), draw);
}

void Reseal(base::Bytes& bytes) {
  for (std::size_t at = 8; at + 9 < bytes.size();) {
    const std::uint64_t length = NumberAt(bytes, at + 1);
    if (length > bytes.size() - at - 9) break;
    const std::size_t end = at + 9 + static_cast<std::size_t>(length);
    if (bytes[at] == std::byte{6} && length >= 40) PutCrc(bytes, at + 9 + 40, end, at + 9 + 24);
    if (bytes[at] == std::byte{9} && length >= 4) PutCrc(bytes, at + 9, end - 4, end - 4);
    if (bytes[at] == std::byte{15} && length >= 4) PutCrc(bytes, 0, at, at + 9);
    at = end;
  }
  if (bytes.size() < 60) return;
  const std::uint64_t summary = NumberAt(bytes, bytes.size() - 28);
  if (summary < bytes.size() - 12)
    PutCrc(bytes, static_cast<std::size_t>(summary), bytes.size() - 12, bytes.size() - 12);
}

}  // namespace rodeira::record

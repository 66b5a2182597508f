// SPDX-License-Identifier: Apache-2.0
// The file against MCAP's description, walked by a small parser of its own: order of records, offsets, checksums.
// (The reference reader has its say in npm_test.cpp.)
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "common/data/record/checksum.hpp"
#include "tests/common/data/record/sample.hpp"

namespace rodeira::record {
namespace {

// CRC-32/ISO-HDLC bit by bit, from its definition.
std::uint32_t SlowCrc(std::span<const std::byte> bytes) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const std::byte byte : bytes) {
    crc ^= static_cast<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

struct Piece {
  int opcode = 0;
  std::size_t at = 0;
  std::size_t end = 0;
  std::span<const std::byte> content;
};

template <class T>
T At(std::span<const std::byte> bytes, std::size_t at) {
  T value;
  EXPECT_LE(at + sizeof value, bytes.size());
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::vector<Piece> Walk(std::span<const std::byte> bytes, std::size_t from, std::size_t to) {
  std::vector<Piece> pieces;
  while (from < to) {
    const auto length = static_cast<std::size_t>(At<std::uint64_t>(bytes, from + 1));
    pieces.push_back({static_cast<int>(bytes[from]), from, from + 9 + length, bytes.subspan(from + 9, length)});
    from += 9 + length;
  }
  EXPECT_EQ(from, to);
  return pieces;
}

const char kMark[] = "\x89MCAP0\r\n";

TEST(Checksum, IsTheOneOfTheStandard) {
  const std::string_view check = "123456789";
  EXPECT_EQ(Crc32(std::as_bytes(std::span(check))), 0xCBF43926u);
  EXPECT_EQ(SlowCrc(std::as_bytes(std::span(check))), 0xCBF43926u);
  EXPECT_EQ(Crc32(std::as_bytes(std::span(check).subspan(4)), Crc32(std::as_bytes(std::span(check).first(4)))),
            0xCBF43926u);
}

TEST(Layout, RecordsComeInTheirOrderWithTheirChecksums) {
  const base::Bytes bytes = Record(SmallPlan(), SmallSettings(Compression::kNone));
  ASSERT_EQ(std::memcmp(bytes.data(), kMark, 8), 0);
  ASSERT_EQ(std::memcmp(bytes.data() + bytes.size() - 8, kMark, 8), 0);
  const auto pieces = Walk(bytes, 8, bytes.size() - 8);
  std::string order;
  for (const Piece& piece : pieces) order += "0123456789ABCDEF"[piece.opcode];
  // Header; chunk and indexes, metadata, …, attachment, …; DataEnd; 3 schemas, 3 channels, statistics, chunk indexes,
  // attachment index, metadata index; a summary offset for each of the six groups; footer.
  EXPECT_EQ(order,
            "1"
            "6777"
            "C"
            "677"
            "67"
            "9"
            "67"
            "67"
            "67"
            "F"
            "333"
            "444"
            "B"
            "888888"
            "A"
            "D"
            "EEEEEE"
            "2");

  for (const Piece& piece : pieces) {
    if (piece.opcode == 6) {
      const auto compression = At<std::uint32_t>(piece.content, 28);
      ASSERT_EQ(compression, 0u);
      const auto records = piece.content.subspan(40);
      EXPECT_EQ(At<std::uint64_t>(piece.content, 32), records.size());
      EXPECT_EQ(At<std::uint64_t>(piece.content, 16), records.size());
      EXPECT_EQ(At<std::uint32_t>(piece.content, 24), SlowCrc(records));
    } else if (piece.opcode == 9) {
      EXPECT_EQ(At<std::uint32_t>(piece.content, piece.content.size() - 4),
                SlowCrc(piece.content.first(piece.content.size() - 4)));
    } else if (piece.opcode == 0xF) {
      EXPECT_EQ(At<std::uint32_t>(piece.content, 0), SlowCrc(std::span(bytes).first(piece.at)));
    } else if (piece.opcode == 2) {
      const auto start = static_cast<std::size_t>(At<std::uint64_t>(piece.content, 0));
      EXPECT_EQ(At<std::uint32_t>(piece.content, 16),
                SlowCrc(std::span(bytes).subspan(start, piece.at + 9 + 16 - start)));
    }
  }
}

TEST(Layout, OffsetsPointAtWhatTheyName) {
  const base::Bytes bytes = Record(SmallPlan(), SmallSettings(Compression::kNone));
  const auto pieces = Walk(bytes, 8, bytes.size() - 8);
  std::map<std::size_t, Piece> by_place;
  for (const Piece& piece : pieces) by_place[piece.at] = piece;
  const Piece& footer = pieces.back();
  const auto summary = static_cast<std::size_t>(At<std::uint64_t>(footer.content, 0));
  const auto offsets = static_cast<std::size_t>(At<std::uint64_t>(footer.content, 8));
  EXPECT_EQ(by_place.at(summary).opcode, 3);
  EXPECT_EQ(by_place.at(offsets).opcode, 0xE);

  int chunk_indexes = 0;
  std::size_t group_from = summary;
  for (const Piece& piece : pieces) {
    if (piece.opcode == 8) {
      ++chunk_indexes;
      const Piece chunk = by_place.at(static_cast<std::size_t>(At<std::uint64_t>(piece.content, 16)));
      EXPECT_EQ(chunk.opcode, 6);
      EXPECT_EQ(At<std::uint64_t>(piece.content, 24), chunk.end - chunk.at);
      EXPECT_EQ(At<std::uint64_t>(piece.content, 0), At<std::uint64_t>(chunk.content, 0));
      EXPECT_EQ(At<std::uint64_t>(piece.content, 8), At<std::uint64_t>(chunk.content, 8));
      const auto entries = At<std::uint32_t>(piece.content, 32) / 10;
      std::size_t index_bytes = 0;
      for (std::uint32_t i = 0; i < entries; ++i) {
        const auto channel = At<std::uint16_t>(piece.content, 36 + 10 * i);
        const Piece index = by_place.at(static_cast<std::size_t>(At<std::uint64_t>(piece.content, 38 + 10 * i)));
        EXPECT_EQ(index.opcode, 7);
        EXPECT_EQ(At<std::uint16_t>(index.content, 0), channel);
        index_bytes += index.end - index.at;
        const auto records = chunk.content.subspan(40);
        for (std::size_t at = 6; at < index.content.size(); at += 16) {
          const auto message = static_cast<std::size_t>(At<std::uint64_t>(index.content, at + 8));
          EXPECT_EQ(static_cast<int>(records[message]), 5);
          EXPECT_EQ(At<std::uint16_t>(records, message + 9), channel);
          EXPECT_EQ(At<std::uint64_t>(records, message + 15), At<std::uint64_t>(index.content, at));
        }
      }
      EXPECT_EQ(At<std::uint64_t>(piece.content, 36 + 10 * entries), index_bytes);
    } else if (piece.opcode == 0xA || piece.opcode == 0xD) {
      const Piece named = by_place.at(static_cast<std::size_t>(At<std::uint64_t>(piece.content, 0)));
      EXPECT_EQ(named.opcode, piece.opcode - 1);
      EXPECT_EQ(At<std::uint64_t>(piece.content, 8), named.end - named.at);
    } else if (piece.opcode == 0xE) {
      EXPECT_EQ(At<std::uint64_t>(piece.content, 1), group_from);  // the groups lie one behind the other
      EXPECT_EQ(by_place.at(group_from).opcode, static_cast<int>(piece.content[0]));
      group_from += static_cast<std::size_t>(At<std::uint64_t>(piece.content, 9));
    }
  }
  EXPECT_EQ(group_from, offsets);
  EXPECT_EQ(chunk_indexes, 6);
}

}  // namespace
}  // namespace rodeira::record

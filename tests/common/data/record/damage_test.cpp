// SPDX-License-Identifier: Apache-2.0
// Whatever is cut off or changed: the file opens with a true part of its messages, or is refused with a sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/names.hpp"

#include "tests/common/data/record/sample.hpp"

namespace rodeira::record {
namespace {

constexpr std::size_t kHeaderEnd = 8 + 9 + 4 + 4 + 7;  // mark, head of the header, "", "rodeira"

class Damage : public testing::TestWithParam<Compression> {
 protected:
  Damage() : bytes_(Record(SmallPlan(), SmallSettings(GetParam()))), messages_(MessagesOf(SmallPlan())) {}

  // The file offset behind each chunk, and how many messages lie before it.
  std::vector<std::pair<std::uint64_t, std::size_t>> Ends() const {
    std::vector<std::pair<std::uint64_t, std::size_t>> ends;
    auto reader = McapReader::OpenBytes(bytes_);
    const std::size_t counts[] = {3, 5, 6, 7, 8, 9};
    std::size_t i = 0;
    for (const ChunkInfo& chunk : reader.value().chunks()) {
      ends.emplace_back(chunk.offset + chunk.record_bytes, counts[i++]);
    }
    return ends;
  }

  base::Bytes bytes_;
  std::vector<Copied> messages_;
};

Read ReadInFileOrder(const McapReader& reader) {
  Query query;
  query.order = Query::Order::kFile;
  return ReadAll(reader, query);
}

TEST_P(Damage, EveryTruncationGivesExactlyTheCompleteChunks) {
  const auto ends = Ends();
  std::uint64_t summary_start = 0;
  std::memcpy(&summary_start, bytes_.data() + bytes_.size() - 28, sizeof summary_start);
  ASSERT_GT(bytes_.size(), kHeaderEnd);
  for (std::size_t size = 0; size < bytes_.size(); ++size) {
    auto reader =
        McapReader::OpenBytes(base::Bytes(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(size)));
    if (size < kHeaderEnd) {
      ASSERT_FALSE(reader.ok()) << size;
      EXPECT_FALSE(reader.error().message.empty());
      continue;
    }
    ASSERT_TRUE(reader.ok()) << size << ": " << reader.error().Text();
    const Condition& condition = reader.value().condition();
    EXPECT_FALSE(condition.by_summary);
    EXPECT_FALSE(condition.whole);
    ASSERT_FALSE(condition.findings.empty());
    EXPECT_NE(condition.findings[0].find("was not closed"), std::string::npos) << condition.findings[0];
    EXPECT_LE(condition.good_bytes, size);
    std::size_t expected = 0;
    for (const auto& [end, count] : ends) {
      if (end <= size) expected = count;
    }
    const Read read = ReadInFileOrder(reader.value());
    EXPECT_TRUE(read.errors.empty());
    ASSERT_EQ(read.messages.size(), expected) << size;
    EXPECT_TRUE(std::ranges::equal(read.messages, std::span(messages_).first(expected)));
    EXPECT_EQ(reader.value().statistics().messages, expected);
    // A cut within a record is said to be a loss; one between records is only an ending that is missing.
    const bool torn = condition.good_bytes < size && size < summary_start;
    EXPECT_EQ(condition.findings.size(), torn ? 2u : 1u);
    if (torn) {
      EXPECT_NE(condition.findings[1].find("everything is lost"), std::string::npos) << condition.findings[1];
    }
  }
}

// Bytes without a checksum of their own that a reader by the summary does not look at, or hands out as they are.
bool InHeader(std::size_t at) { return at < kHeaderEnd; }

TEST_P(Damage, NoSingleByteGivesAWrongMessageInSilence) {
  const auto sorted = [&] {
    auto copy = messages_;
    std::ranges::sort(copy);
    return copy;
  }();
  ASSERT_GT(bytes_.size(), kHeaderEnd);
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    for (const int flip : {0x01, 0x80, 0xFF, 0x20, static_cast<int>(bytes_[at])}) {  // the last one gives zero
      if (flip == 0) continue;
      base::Bytes changed = bytes_;
      changed[at] ^= static_cast<std::byte>(flip);
      auto opened = McapReader::OpenBytes(changed);
      if (!opened) {
        EXPECT_TRUE(InHeader(at)) << at << ": " << opened.error().Text();
        continue;
      }
      const McapReader& reader = opened.value();
      const Read read = ReadInFileOrder(reader);
      auto got = read.messages;
      std::ranges::sort(got);
      ASSERT_TRUE(std::ranges::includes(sorted, got)) << "byte " << at << ": a message that was never written";
      if (got.size() < messages_.size()) {
        EXPECT_TRUE(!read.errors.empty() || !reader.condition().findings.empty())
            << "byte " << at << ": a message is missing and nothing was said";
      }
      EXPECT_FALSE(reader.Verify().empty()) << "byte " << at << ": Verify saw nothing";
    }
  }
}

TEST_P(Damage, ADamagedChunkCostsOnlyItselfWhereTheSummaryIsWhole) {
  const ChunkInfo chunk = McapReader::OpenBytes(bytes_).value().chunks()[1];
  base::Bytes changed = bytes_;
  changed[chunk.offset + chunk.record_bytes - 5] ^= std::byte{4};
  auto reader = McapReader::OpenBytes(changed);
  ASSERT_TRUE(reader.ok());
  EXPECT_TRUE(reader.value().condition().by_summary);
  const Read read = ReadAll(reader.value());
  EXPECT_EQ(read.messages.size(), 7u);
  ASSERT_EQ(read.errors.size(), 1u);
  EXPECT_THAT(read.errors[0], Names("chunk … 0.000 s to 0.000 s … damaged"));
  EXPECT_NE(read.errors[0].find("byte " + std::to_string(chunk.offset)), std::string::npos);
}

TEST_P(Damage, ADamagedSummaryCostsNothing) {
  base::Bytes changed = bytes_;
  changed[changed.size() - 60] ^= std::byte{4};
  auto reader = McapReader::OpenBytes(changed);
  ASSERT_TRUE(reader.ok());
  EXPECT_FALSE(reader.value().condition().by_summary);
  EXPECT_EQ(reader.value().condition().findings.size(), 1u);
  EXPECT_EQ(ReadAll(reader.value()).messages.size(), messages_.size());
}

TEST_P(Damage, ChangedMetadataIsSeenByVerify) {
  auto whole = McapReader::OpenBytes(bytes_);
  base::Bytes changed = bytes_;
  changed[whole.value().metadata()[0].offset + 9 + 5] ^= std::byte{1};
  auto reader = McapReader::OpenBytes(changed);
  const auto findings = reader.value().Verify();
  ASSERT_FALSE(findings.empty());
  EXPECT_NE(findings[0].find("something outside of the chunks"), std::string::npos) << findings[0];
}

INSTANTIATE_TEST_SUITE_P(Compressions, Damage, testing::Values(Compression::kNone, Compression::kZstd),
                         [](const auto& test) { return test.param == Compression::kNone ? "None" : "Zstd"; });

}  // namespace
}  // namespace rodeira::record

// SPDX-License-Identifier: Apache-2.0
// Files of other programs: everything that MCAP's specification permits is read, and repair keeps every message or says
// which it lost. The right answers are the messages that the test's own writer was given.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "common/data/record/compress.hpp"
#include "common/data/record/repair.hpp"
#include "tests/common/data/record/foreign.hpp"
#include "tests/names.hpp"
#include "tests/setting.hpp"

namespace rodeira::record {
namespace {

constexpr std::uint64_t kForms = 3000;

std::vector<Copied> InFileOrder(const McapReader& reader) {
  Query query;
  query.order = Query::Order::kFile;
  const Read read = ReadAll(reader, query);
  EXPECT_EQ(read.errors, std::vector<std::string>{});
  return read.messages;
}

std::vector<Copied> ByTime(std::vector<Copied> messages) {
  std::ranges::stable_sort(messages, {}, &Copied::log_time_ns);
  return messages;
}

void ExpectAllOf(const McapReader& reader, const std::vector<Copied>& messages) {
  EXPECT_EQ(InFileOrder(reader), messages);
  EXPECT_EQ(ReadAll(reader).messages, ByTime(messages));
  EXPECT_EQ(reader.statistics().messages, messages.size());
  for (const char* topic : kTopics) {
    Query query;
    query.from_ns = 1'000'000'000;
    query.through_ns = 2'000'000'000;
    query.channels.emplace();
    for (const ChannelId id : reader.ChannelsOf(topic)) query.channels->insert(id);
    std::vector<Copied> expected = ByTime(messages);
    std::erase_if(expected, [&](const Copied& m) {
      return m.topic != topic || m.log_time_ns < query.from_ns || m.log_time_ns > query.through_ns;
    });
    EXPECT_EQ(ReadAll(reader, query).messages, expected) << topic;
  }
  std::size_t by_chunk = 0;
  for (const ChunkInfo& info : reader.chunks()) {
    const auto chunk = reader.ReadChunk(info);
    ASSERT_TRUE(chunk.ok()) << chunk.error().Text();
    by_chunk += chunk.value().messages.size();
  }
  EXPECT_EQ(by_chunk, messages.size());
  const auto metadata = reader.FindMetadata("about");
  ASSERT_TRUE(metadata.ok() && metadata.value().has_value());
  EXPECT_EQ(metadata.value()->entries, (TextMap{{"key", "value"}}));
  const auto attachment = reader.FindAttachment("file.txt");
  ASSERT_TRUE(attachment.ok() && attachment.value().has_value());
  EXPECT_EQ(attachment.value()->data.size(), 4u);
}

void ExpectWhole(const base::Bytes& bytes, const std::vector<Copied>& messages, bool scan) {
  ReaderSettings settings;
  settings.scan = scan;
  const auto opened = McapReader::OpenBytes(bytes, settings);
  ASSERT_TRUE(opened.ok()) << opened.error().Text();
  const McapReader& reader = opened.value();
  EXPECT_EQ(reader.condition().findings, std::vector<std::string>{});
  EXPECT_TRUE(reader.condition().whole);
  EXPECT_EQ(reader.condition().good_bytes, bytes.size());
  EXPECT_EQ(reader.Verify(), std::vector<std::string>{});
  ExpectAllOf(reader, messages);
}

TEST(Foreign, EveryFormOfTheSpecificationIsReadWhole) {
  for (std::uint64_t number = 0; number < kForms; ++number) {
    Draw draw(number);
    const Form form = DrawForm(draw);
    const auto calls = DrawPlan(draw);
    SCOPED_TRACE(fmt::format("form {}: {}", number, Text(form)));
    const base::Bytes bytes = ForeignRecord(calls, form);
    ExpectWhole(bytes, MessagesOf(calls), false);
    ExpectWhole(bytes, MessagesOf(calls), true);
    if (HasFailure()) return;
  }
}

TEST(Foreign, RepairKeepsEveryMessageOfEveryForm) {
  for (std::uint64_t number = 0; number < kForms; ++number) {
    Draw draw(number);
    const Form form = DrawForm(draw);
    const auto calls = DrawPlan(draw);
    SCOPED_TRACE(fmt::format("form {}: {}", number, Text(form)));
    base::Bytes repaired;
    const auto report = RepairBytes(ForeignRecord(calls, form), &repaired);
    ASSERT_TRUE(report.ok()) << report.error().Text();
    EXPECT_TRUE(report.value().was_whole);
    EXPECT_EQ(report.value().kept.messages, MessagesOf(calls).size());
    // Records of applications are not copied, which is a loss and is said.
    EXPECT_EQ(report.value().lost, form.unknown_records) << report.value().Text();
    EXPECT_EQ(report.value().losses.size(), form.unknown_records ? 1u : 0u) << report.value().Text();
    ExpectWhole(repaired, MessagesOf(calls), false);
    const auto reader = McapReader::OpenBytes(repaired);
    EXPECT_TRUE(reader.value().condition().by_summary);
    EXPECT_EQ(reader.value().header().library, form.library);
    if (form.silent_channel && (form.messages_a_chunk == 0 || form.definitions_outside || !calls.empty())) {
      EXPECT_EQ(reader.value().ChannelsOf("silent").size(), 1u);
    }
    if (HasFailure()) return;
  }
}

TEST(Foreign, AWholeSummaryOfAnotherProgramSavesReadingTheFile) {
  Form form;
  const base::Bytes bytes = ForeignRecord(SmallPlan(), form);
  EXPECT_TRUE(McapReader::OpenBytes(bytes).value().condition().by_summary);
  form.every_nth_outside = 3;  // its chunk indexes do not lead to those
  EXPECT_FALSE(McapReader::OpenBytes(ForeignRecord(SmallPlan(), form)).value().condition().by_summary);
}

// The same forms, called "rodeira": this program does not write them, so they are damaged.
TEST(Foreign, WhatThisProgramDoesNotWriteIsDamageInItsOwnFiles) {
  const auto finding = [](const Form& form) {
    const auto reader = McapReader::OpenBytes(ForeignRecord(SmallPlan(), form));
    if (!reader) return reader.error().Text();
    const auto findings = reader.value().Verify();
    return findings.empty() ? std::string("none") : findings.front();
  };
  const auto own = [] {
    Form form;
    form.library = kLibrary;
    return form;
  };
  EXPECT_EQ(finding(own()), "none");
  Form form = own();
  form.messages_a_chunk = 0;
  EXPECT_NE(finding(form).find("a message outside of a chunk"), std::string::npos) << finding(form);
  form = own();
  form.compression = "lz4";
  EXPECT_NE(finding(form).find("its compression is 'lz4', none or 'zstd' was expected"), std::string::npos);
  form = own();
  form.statistics = false;
  EXPECT_EQ(finding(form), "its summary has no statistics");
  form = own();
  form.chunk_indexes = false;
  EXPECT_EQ(finding(form), "its summary's statistics do not fit the rest of the summary");
  form = own();
  form.channels = false;
  EXPECT_NE(finding(form), "none");
  form = own();
  form.schemas = form.channels = form.statistics = form.chunk_indexes = false;
  form.attachment_indexes = form.metadata_indexes = form.summary_offsets = false;
  EXPECT_EQ(finding(form), "it was written without a summary");
  form = own();
  form.unknown_fields = true;
  EXPECT_NE(finding(form), "none");
}

// A file cut at any byte gives what lay before it, and repair says that something is lost, unless it was cut between
// two records.
TEST(Foreign, EveryTruncationOfMessagesOutsideOfChunksKeepsTheCompleteOnes) {
  Form form;
  form.messages_a_chunk = 0;
  const base::Bytes bytes = ForeignRecord(SmallPlan(), form);
  const auto messages = MessagesOf(SmallPlan());
  std::size_t kept_before = 0;
  for (std::size_t size = 60; size < bytes.size(); ++size) {
    const base::Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    const auto reader = McapReader::OpenBytes(cut);
    ASSERT_TRUE(reader.ok()) << size;
    EXPECT_FALSE(reader.value().condition().whole);
    const auto kept = InFileOrder(reader.value());
    ASSERT_TRUE(kept.size() <= messages.size() && std::ranges::equal(kept, std::span(messages).first(kept.size())));
    EXPECT_GE(kept.size(), kept_before);
    kept_before = kept.size();
    base::Bytes repaired;
    const auto report = RepairBytes(cut, &repaired);
    ASSERT_TRUE(report.ok());
    EXPECT_FALSE(report.value().was_whole);
    EXPECT_EQ(report.value().kept.messages, kept.size());
    const bool torn = reader.value().condition().good_bytes < size;
    if (kept.size() < messages.size()) {
      EXPECT_EQ(report.value().lost, torn) << size << ": " << report.value().Text();
    }
  }
  EXPECT_EQ(kept_before, messages.size());
}

TEST(Foreign, ADamagedChunkIsLostAndWhatFollowsIsNot) {
  Form form;
  form.definitions_outside = true;
  form.statistics = form.chunk_indexes = false;
  const base::Bytes bytes = ForeignRecord(SmallPlan(), form);
  const auto whole = McapReader::OpenBytes(bytes);
  ASSERT_GE(whole.value().chunks().size(), 3u);
  const ChunkInfo& chunk = whole.value().chunks()[1];
  const std::size_t in_it = whole.value().ReadChunk(chunk).value().messages.size();
  base::Bytes changed = bytes;
  changed[chunk.offset + chunk.record_bytes - 3] ^= std::byte{1};
  base::Bytes repaired;
  const auto report = RepairBytes(changed, &repaired);
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(report.value().lost);
  EXPECT_EQ(report.value().kept.messages, MessagesOf(SmallPlan()).size() - in_it);
  EXPECT_THAT(report.value().Text(), Names(fmt::format("byte {}: … chunk", chunk.offset)));
}

TEST(Foreign, AnUnknownCompressionIsNamedAndIsALoss) {
  Form form;
  form.definitions_outside = true;
  base::Bytes bytes = ForeignRecord(SmallPlan(), form);
  form.compression = "lz4";
  base::Bytes packed = ForeignRecord(SmallPlan(), form);
  const std::string_view text(reinterpret_cast<const char*>(packed.data()), packed.size());
  for (std::size_t at = text.find("lz4"); at != std::string_view::npos; at = text.find("lz4", at + 1)) {
    packed[at] = std::byte{'b'};
  }
  base::Bytes repaired;
  const auto report = RepairBytes(packed, &repaired);
  ASSERT_TRUE(report.ok()) << report.error().Text();
  EXPECT_TRUE(report.value().lost);
  EXPECT_EQ(report.value().kept.messages, 0u);
  EXPECT_NE(report.value().Text().find("its compression is 'bz4', none, 'zstd' or 'lz4' was expected"),
            std::string::npos)
      << report.value().Text();
}

TEST(Foreign, StatisticsThatNameOtherMessagesAreFound) {
  Form form;
  form.checksums = form.channel_counts = form.summary_offsets = form.attachment_indexes = form.metadata_indexes = false;
  form.messages_a_chunk = 0;
  base::Bytes bytes = ForeignRecord(SmallPlan(), form);
  const std::string counts("\x09\0\0\0\0\0\0\0\x03\0\x03", 11);  // messages, schemas, channels
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t at = text.find(counts);
  ASSERT_NE(at, std::string_view::npos);
  bytes[at] = std::byte{12};
  const auto reader = McapReader::OpenBytes(bytes);
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reader.value().Verify(),
            std::vector<std::string>{"the summary's statistics name 12 messages, 9 were found"});
  base::Bytes repaired;
  EXPECT_TRUE(RepairBytes(bytes, &repaired).value().lost);
}

// The reference writer (npm's @mcap/core 2.2.2) does so behind messages outside of chunks.
TEST(Foreign, AnAttachmentIndexThatNamesAnotherPlaceLosesNothing) {
  Form form;
  form.checksums = form.summary_offsets = form.metadata_indexes = false;
  form.messages_a_chunk = 0;
  base::Bytes bytes = ForeignRecord(SmallPlan(), form);
  const auto place = McapReader::OpenBytes(bytes).value().attachments()[0].offset;
  const auto known = std::as_bytes(std::span(&place, 1));
  const auto at = std::ranges::search(std::span(bytes).subspan(place), known).begin();
  ASSERT_EQ(*at, known[0]);
  const std::uint64_t wrong = place - 20;
  std::memcpy(&*at, &wrong, sizeof wrong);
  EXPECT_NE(McapReader::OpenBytes(bytes).value().Verify(), std::vector<std::string>{});
  base::Bytes repaired;
  const auto report = RepairBytes(bytes, &repaired);
  ASSERT_TRUE(report.ok());
  EXPECT_FALSE(report.value().lost) << report.value().Text();
  EXPECT_FALSE(report.value().was_whole);
  ExpectAllOf(McapReader::OpenBytes(repaired).value(), MessagesOf(SmallPlan()));
}

TEST(Foreign, DataEndBeforeTheLastMessageHidesNothing) {
  Form form;
  form.messages_a_chunk = 0;
  form.checksums = form.data_end = form.summary_offsets = false;
  form.schemas = form.channels = form.statistics = form.chunk_indexes = false;
  form.attachment_indexes = form.metadata_indexes = false;
  const base::Bytes bytes = ForeignRecord(SmallPlan(), form);
  const auto run = McapReader::OpenBytes(bytes).value().chunks().back();
  base::Bytes changed = bytes;
  const std::byte end[] = {std::byte{15}, std::byte{4}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(run.offset), std::begin(end), std::end(end));
  const auto reader = McapReader::OpenBytes(changed);
  ASSERT_TRUE(reader.ok());
  EXPECT_FALSE(reader.value().condition().whole);
  base::Bytes repaired;
  const auto report = RepairBytes(changed, &repaired);
  EXPECT_TRUE(report.value().lost);
  EXPECT_NE(report.value().Text().find("the footer says that they end at byte"), std::string::npos);
}

// The largest ratio of lz4 is 255; what claims more is refused before memory is allocated.
TEST(Foreign, TheSizeThatAFrameClaimsIsNotBelieved) {
  Form form;
  form.compression = "lz4";
  base::Bytes bytes = ForeignRecord(SmallPlan(), form);
  const auto chunk = McapReader::OpenBytes(bytes).value().chunks()[0];
  const std::uint64_t claimed = kMaxRecordBytes;
  std::memcpy(bytes.data() + chunk.offset + 9 + 16, &claimed, sizeof claimed);
  const auto reader = McapReader::OpenBytes(bytes, {.scan = true});
  ASSERT_TRUE(reader.ok());
  ASSERT_FALSE(reader.value().condition().findings.empty());
  EXPECT_NE(reader.value().condition().findings.front().find("compressed bytes cannot hold 268435456 bytes"),
            std::string::npos)
      << reader.value().condition().findings.front();
  const auto refused = [](std::size_t size, std::uint64_t said) {
    Form small;
    small.compression = "lz4";
    const base::Bytes file = ForeignRecord(SmallPlan(), small);
    const auto info = McapReader::OpenBytes(file).value().chunks()[0];
    const std::size_t at = info.offset + info.record_bytes - info.compressed_bytes;
    return Lz4Decompress(std::span(file).subspan(at, size), said).error().message;
  };
  EXPECT_EQ(refused(chunk.compressed_bytes, chunk.uncompressed_bytes - 1),
            fmt::format("it holds more than the {} bytes that were expected", chunk.uncompressed_bytes - 1));
  EXPECT_EQ(refused(chunk.compressed_bytes, chunk.uncompressed_bytes + 1),
            fmt::format("it holds {} bytes, {} were expected", chunk.uncompressed_bytes, chunk.uncompressed_bytes + 1));
  EXPECT_EQ(refused(chunk.compressed_bytes - 5, chunk.uncompressed_bytes), "its lz4 frame is incomplete");
  EXPECT_EQ(refused(3, 0), "its lz4 frame is incomplete");
  EXPECT_EQ(refused(0, 0), "its lz4 frame is incomplete");
}

TEST(Foreign, ALongRunOfMessagesIsReadPieceByPiece) {
  Form form;
  form.messages_a_chunk = 0;
  std::vector<Call> calls(6000, {Call::Kind::kMessage, 0, 0, 1000});
  for (std::size_t i = 0; i < calls.size(); ++i) calls[i].log_time_ns = i;
  const base::Bytes bytes = ForeignRecord(calls, form);
  const auto reader = McapReader::OpenBytes(bytes, {.scan = false, .memory_bytes = 3u << 20});
  ASSERT_TRUE(reader.ok());
  EXPECT_GE(reader.value().chunks().size(), 5u);
  for (const ChunkInfo& run : reader.value().chunks()) EXPECT_LE(run.record_bytes, 1u << 20);
  EXPECT_EQ(ReadAll(reader.value()).messages, MessagesOf(calls));
}

}  // namespace
}  // namespace rodeira::record

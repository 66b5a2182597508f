// SPDX-License-Identifier: Apache-2.0
// What was written comes back: content, order by log time (ties in file order), queries.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/common/data/record/sample.hpp"

namespace rodeira::record {
namespace {

rc::Gen<std::vector<Call>> Calls() {
  using enum Call::Kind;
  return rc::gen::container<std::vector<Call>>(rc::gen::build<Call>(
      rc::gen::set(&Call::kind, rc::gen::weightedElement<Call::Kind>(
                                    {{20, kMessage}, {1, kMetadata}, {1, kAttachment}, {1, kFlush}})),
      rc::gen::set(&Call::channel, rc::gen::inRange<std::uint8_t>(0, 3)),
      rc::gen::set(&Call::log_time_ns,
                   rc::gen::oneOf(rc::gen::inRange<std::uint64_t>(0, 4000), rc::gen::arbitrary<std::uint64_t>())),
      rc::gen::set(&Call::bytes,
                   rc::gen::oneOf(rc::gen::inRange<std::uint16_t>(0, 60), rc::gen::inRange<std::uint16_t>(0, 9000)))));
}

WriterSettings AnySettings() {
  WriterSettings settings;
  settings.compression = *rc::gen::element(Compression::kNone, Compression::kZstd);
  settings.chunk_span_ns = *rc::gen::inRange<std::uint64_t>(1, 3000);
  settings.chunk_bytes = *rc::gen::inRange<std::uint64_t>(4096, 12000);
  return settings;
}

std::vector<Copied> InLogTimeOrder(std::vector<Copied> messages) {
  std::ranges::stable_sort(messages, {}, &Copied::log_time_ns);
  return messages;
}

RC_GTEST_PROP(Reader, GivesBackWhatWasWritten, ()) {
  const auto calls = *Calls();
  const base::Bytes bytes = Record(calls, AnySettings());
  const auto messages = MessagesOf(calls);
  for (const bool scan : {false, true}) {
    ReaderSettings settings;
    settings.scan = scan;
    auto reader = McapReader::OpenBytes(bytes, settings);
    RC_ASSERT(reader.ok());
    RC_ASSERT(reader.value().condition().by_summary == !scan);
    RC_ASSERT(reader.value().condition().whole);
    RC_ASSERT(reader.value().Verify() == std::vector<std::string>{});
    RC_ASSERT(ReadAll(reader.value()).messages == InLogTimeOrder(messages));
    Query query;
    query.order = Query::Order::kFile;
    RC_ASSERT(ReadAll(reader.value(), query).messages == messages);
    RC_ASSERT(reader.value().statistics().messages == messages.size());
  }
}

RC_GTEST_PROP(Reader, AQueryIsAFilter, ()) {
  const auto calls = *Calls();
  auto reader = McapReader::OpenBytes(Record(calls, AnySettings()));
  RC_ASSERT(reader.ok());
  Query query;
  query.from_ns = *rc::gen::inRange<std::uint64_t>(0, 3000);
  query.through_ns = *rc::gen::inRange<std::uint64_t>(0, 5000);
  const auto wanted = *rc::gen::container<std::vector<ChannelId>>(rc::gen::inRange<ChannelId>(1, 5));
  query.channels.emplace(wanted.begin(), wanted.end());
  std::vector<Copied> expected;
  for (const Copied& message : InLogTimeOrder(MessagesOf(calls))) {
    const auto id = static_cast<ChannelId>(std::ranges::find(kTopics, message.topic) - std::begin(kTopics) + 1);
    if (message.log_time_ns < query.from_ns || message.log_time_ns > query.through_ns) continue;
    if (query.channels->contains(id)) expected.push_back(message);
  }
  RC_ASSERT(ReadAll(reader.value(), query).messages == expected);
}

TEST(Reader, KnowsSchemasChannelsMetadataAttachmentsStatistics) {
  for (const bool scan : {false, true}) {
    ReaderSettings settings;
    settings.scan = scan;
    auto opened = McapReader::OpenBytes(Record(SmallPlan(), SmallSettings(Compression::kZstd)), settings);
    ASSERT_TRUE(opened.ok());
    const McapReader& reader = opened.value();
    EXPECT_EQ(reader.header(), (Header{"", "rodeira"}));
    ASSERT_EQ(reader.schemas().size(), 3u);
    EXPECT_EQ(reader.schemas().at(2),
              (Schema{2, "probe::Type1", "omgidl", "module probe { struct Type1 { long x; }; };"}));
    EXPECT_EQ(reader.channels().at(3), (Channel{3, 3, "events", "cdr", {{"source", "14"}}}));
    EXPECT_EQ(reader.ChannelsOf("clock/grant"), std::vector<ChannelId>{2});
    EXPECT_EQ(reader.ChannelsOf("nothing"), std::vector<ChannelId>{});
    const Statistics expected{.messages = 9,
                              .schemas = 3,
                              .channels = 3,
                              .attachments = 1,
                              .metadata = 1,
                              .chunks = 6,
                              .first_log_time_ns = 0,
                              .last_log_time_ns = 2200,
                              .messages_by_channel = {{1, 4}, {2, 3}, {3, 2}}};
    EXPECT_EQ(reader.statistics(), expected);
    auto metadata = reader.FindMetadata("meta3");
    ASSERT_TRUE(metadata.ok() && metadata.value().has_value());
    EXPECT_EQ(metadata.value()->entries, (TextMap{{"bytes", "3"}, {"k", ""}}));
    EXPECT_FALSE(reader.FindMetadata("none").value().has_value());
    auto attachment = reader.FindAttachment("file8");
    ASSERT_TRUE(attachment.ok() && attachment.value().has_value());
    EXPECT_EQ(attachment.value()->media_type, "text/plain");
    EXPECT_EQ(attachment.value()->log_time_ns, 77u);
    EXPECT_EQ(attachment.value()->create_time_ns, 8u);
    EXPECT_EQ(attachment.value()->data.size(), 19u);
    EXPECT_FALSE(reader.FindAttachment("none").value().has_value());
  }
}

// A later chunk that begins earlier holds a message of the very time at which an earlier chunk begins.
TEST(Reader, EqualTimesInOverlappingChunksComeInFileOrder) {
  using enum Call::Kind;
  const std::vector<Call> calls{{kMessage, 0, 5, 1}, {kFlush, 0, 0, 0}, {kMessage, 0, 1, 1}, {kMessage, 0, 5, 1}};
  auto reader = McapReader::OpenBytes(Record(calls, SmallSettings(Compression::kNone)));
  ASSERT_TRUE(reader.ok());
  std::vector<std::uint32_t> order;
  for (const Copied& message : ReadAll(reader.value()).messages) order.push_back(message.sequence);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{2, 0, 3}));
}

TEST(Reader, ACursorOutlivesItsReader) {
  auto cursor = McapReader::OpenBytes(Record(SmallPlan(), SmallSettings(Compression::kNone))).value().Messages();
  int count = 0;
  while (cursor.Next().value().has_value()) ++count;
  EXPECT_EQ(count, 9);
}

TEST(Reader, OverlappingChunksBeyondTheMemoryAreAnErrorAndNotAllocated) {
  std::vector<Call> calls;
  for (int i = 0; i < 20; ++i) {
    calls.push_back({Call::Kind::kMessage, 0, 5, 3000});
    calls.push_back({Call::Kind::kFlush, 0, 0, 0});
  }
  ReaderSettings settings;
  settings.memory_bytes = 10'000;
  auto reader = McapReader::OpenBytes(Record(calls, SmallSettings(Compression::kNone)), settings);
  ASSERT_TRUE(reader.ok());
  const Read read = ReadAll(reader.value());
  ASSERT_FALSE(read.errors.empty());
  EXPECT_NE(read.errors[0].find("need more than 10000 bytes of memory"), std::string::npos) << read.errors[0];
  Query query;
  query.order = Query::Order::kFile;  // one chunk at a time
  EXPECT_EQ(ReadAll(reader.value(), query).messages.size(), 20u);
}

TEST(Reader, RefusesWhatIsNoRecording) {
  const auto text_of = [](std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return McapReader::OpenBytes(base::Bytes(bytes.begin(), bytes.end())).error().Text();
  };
  EXPECT_EQ(text_of(""), "memory: this is no MCAP recording: it does not begin with MCAP's mark");
  EXPECT_EQ(text_of("PK and something else that is long enough"),
            "memory: this is no MCAP recording: it does not begin with MCAP's mark");
  EXPECT_THAT(text_of("rodeira: launch/1\nnodes: {}\n"), testing::HasSubstr("launch file; run it: rodeira run memory"));
  base::Bytes other = Record(SmallPlan(), SmallSettings(Compression::kZstd));
  other[5] = std::byte{'7'};
  EXPECT_EQ(McapReader::OpenBytes(other).error().Text(),
            "memory: a recording of MCAP's version 7 was found, version 0 was expected");
  EXPECT_EQ(McapReader::Open("/nowhere/at/all.mcap").error().Text(), "/nowhere/at/all.mcap: there is no such file");
  EXPECT_EQ(McapReader::Open("/tmp").error().Text(), "/tmp: this is not a file, a recording was expected");
}

}  // namespace
}  // namespace rodeira::record

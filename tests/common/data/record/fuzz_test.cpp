// SPDX-License-Identifier: Apache-2.0
// Many seeded mutations of small files: the reader, Verify and Repair never crash, and never hand out a message that
// was not written. In other programs' files messages may lie outside of checksums: Verify sees what was changed.
// RODEIRA_FUZZ_FILES sets how many files are tried, RODEIRA_FUZZ_FIRST with which number they begin.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/data/record/repair.hpp"
#include "tests/common/data/record/foreign.hpp"
#include "tests/common/data/record/mutated.hpp"
#include "tests/common/data/record/sample.hpp"
#include "tests/property/last_words.hpp"
#include "tests/setting.hpp"

namespace rodeira::record {
namespace {

// Everything a user of the reader can ask for. Returns how many messages came.
std::size_t UseAll(const base::Bytes& bytes, bool scan, const std::set<Copied>* known) {
  ReaderSettings settings;
  settings.scan = scan;
  auto opened = McapReader::OpenBytes(bytes, settings);
  if (!opened) {
    EXPECT_FALSE(opened.error().message.empty());
    return 0;
  }
  const McapReader& reader = opened.value();
  const Read read = ReadAll(reader);
  if (known != nullptr) {
    for (const Copied& message : read.messages) EXPECT_TRUE(known->contains(message));
  }
  Query query;
  query.order = Query::Order::kFile;
  query.channels = std::set<ChannelId>{1, 3};
  query.through_ns = 1000;
  EXPECT_LE(ReadAll(reader, query).messages.size(), read.messages.size());
  std::size_t chunk_by_chunk = 0;
  for (const ChunkInfo& info : reader.chunks()) {
    const auto chunk = reader.ReadChunk(info);
    if (chunk) chunk_by_chunk += chunk.value().messages.size();
  }
  EXPECT_EQ(chunk_by_chunk, read.messages.size());
  for (const MetadataInfo& info : reader.metadata()) static_cast<void>(reader.ReadMetadata(info).ok());
  for (const AttachmentInfo& info : reader.attachments()) static_cast<void>(reader.ReadAttachment(info).ok());
  return read.messages.size();
}

TEST(Fuzz, MutatedFilesNeitherCrashNorLie) {
  std::vector<base::Bytes> seeds;
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    seeds.push_back(Record(SmallPlan(), SmallSettings(compression)));
    seeds.push_back(Record({}, SmallSettings(compression)));
  }
  const auto messages = MessagesOf(SmallPlan());
  const std::set<Copied> known(messages.begin(), messages.end());
  std::size_t opened = 0;
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0);
  const std::size_t count = Setting("RODEIRA_FUZZ_FILES", 5000);
  property::SayWhereItDies();
  for (std::size_t file = first; file < first + count; ++file) {
    property::NowTrying("file", file);
    Draw draw(file);
    base::Bytes bytes = seeds[draw.Below(seeds.size())];
    const std::size_t mutations = 1 + draw.Below(4);
    for (std::size_t i = 0; i < mutations && !bytes.empty(); ++i) Mutate(bytes, draw);
    const bool resealed = draw.Below(2) == 0;
    if (resealed) Reseal(bytes);
    // With several changes one may take the checksum out of force and another touch its bytes.
    if (UseAll(bytes, file % 2 == 0, mutations == 1 && !resealed ? &known : nullptr) > 0) ++opened;
    if (file % 10 == 0) {
      base::Bytes repaired;
      const auto report = RepairBytes(bytes, &repaired);
      if (report) {
        auto again = McapReader::OpenBytes(repaired);
        ASSERT_TRUE(again.ok()) << file;
        EXPECT_EQ(again.value().Verify(), std::vector<std::string>{}) << file;
        EXPECT_EQ(again.value().statistics().messages, report.value().kept.messages) << file;
      }
    }
    if (testing::Test::HasFailure()) FAIL() << property::g_last_words;
  }
  if (count < 1000) return;
  EXPECT_GT(opened, count / 10);  // the mutations are not so wild that all is refused at the door
}

TEST(Fuzz, MutatedFilesOfOtherProgramsNeitherCrashNorLie) {
  const std::size_t first = Setting("RODEIRA_FUZZ_FIRST", 0);
  const std::size_t count = Setting("RODEIRA_FUZZ_FILES", 5000);
  std::size_t opened = 0;
  property::SayWhereItDies();
  for (std::size_t file = first; file < first + count; ++file) {
    property::NowTrying("file of another program", file);
    Draw draw(file);
    const Form form = DrawForm(draw);
    const auto calls = DrawPlan(draw);
    base::Bytes bytes = ForeignRecord(calls, form);
    const std::size_t mutations = 1 + draw.Below(4);
    for (std::size_t i = 0; i < mutations && !bytes.empty(); ++i) {
      if (draw.Below(2) == 0) {
        Mutate(bytes, draw);
      } else {
        MutateARecord(bytes, draw);
      }
    }
    const bool resealed = draw.Below(2) == 0;
    if (resealed) Reseal(bytes);
    if (UseAll(bytes, file % 2 == 0, nullptr) > 0) ++opened;
    const auto reader = McapReader::OpenBytes(bytes);
    const bool sealed = form.checksums && form.data_end && mutations == 1 && !resealed;
    if (reader && sealed && reader.value().Verify().empty()) {
      Query query;
      query.order = Query::Order::kFile;
      EXPECT_EQ(ReadAll(reader.value(), query).messages, MessagesOf(calls)) << file << ": changed in silence";
    }
    if (file % 4 == 0) {
      base::Bytes repaired;
      const auto report = RepairBytes(bytes, &repaired);
      if (report) {
        auto again = McapReader::OpenBytes(repaired);
        ASSERT_TRUE(again.ok()) << file;
        EXPECT_EQ(again.value().Verify(), std::vector<std::string>{}) << file;
        EXPECT_EQ(again.value().statistics().messages, report.value().kept.messages) << file;
        EXPECT_TRUE(!report.value().was_whole || !reader || reader.value().Verify().empty()) << file;
        if (sealed && !report.value().lost) {
          EXPECT_EQ(report.value().kept.messages, MessagesOf(calls).size()) << file << ": a loss in silence";
        }
      }
    }
    if (testing::Test::HasFailure()) FAIL() << property::g_last_words;
  }
  if (count < 1000) return;
  EXPECT_GT(opened, count / 10);
}

}  // namespace
}  // namespace rodeira::record

// SPDX-License-Identifier: Apache-2.0
// A repaired file is what the writer would have written of the part that is left.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/data/record/repair.hpp"
#include "tests/common/data/record/sample.hpp"

namespace rodeira::record {
namespace {

namespace fs = std::filesystem;

TEST(Repair, AWholeFileGivesItselfByteForByte) {
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    const base::Bytes bytes = Record(SmallPlan(), SmallSettings(compression));
    base::Bytes repaired;
    auto report = RepairBytes(bytes, &repaired);
    ASSERT_TRUE(report.ok()) << report.error().Text();
    EXPECT_TRUE(report.value().was_whole);
    EXPECT_TRUE(report.value().losses.empty());
    EXPECT_EQ(repaired, bytes);
  }
}

TEST(Repair, EveryTruncationGivesAWholeFileWithWhatWasComplete) {
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    const base::Bytes bytes = Record(SmallPlan(), SmallSettings(compression));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const base::Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      base::Bytes repaired;
      auto report = RepairBytes(cut, &repaired);
      auto damaged = McapReader::OpenBytes(cut);
      ASSERT_EQ(report.ok(), damaged.ok()) << size;
      if (!report) continue;
      EXPECT_FALSE(report.value().was_whole);
      EXPECT_FALSE(report.value().losses.empty());
      auto reader = McapReader::OpenBytes(repaired);
      ASSERT_TRUE(reader.ok());
      EXPECT_TRUE(reader.value().condition().by_summary);
      EXPECT_EQ(reader.value().Verify(), std::vector<std::string>{});
      EXPECT_EQ(ReadAll(reader.value()).messages, ReadAll(damaged.value()).messages);
      EXPECT_EQ(reader.value().channels(), damaged.value().channels());
      EXPECT_EQ(reader.value().attachments().size(), damaged.value().attachments().size());
      auto statement = reader.value().FindMetadata(kRepairMetadata);
      ASSERT_TRUE(statement.ok() && statement.value().has_value());
      EXPECT_EQ(statement.value()->entries.at("source_bytes"), std::to_string(size));
    }
  }
}

TEST(Repair, WithAWholeSummaryOnlyTheDamagedChunkIsLeftOut) {
  const base::Bytes bytes = Record(SmallPlan(), SmallSettings(Compression::kZstd));
  auto whole = McapReader::OpenBytes(bytes);
  // The first chunk holds all the definitions too.
  const std::size_t messages_without[] = {6, 7, 8, 8, 8, 8};
  for (std::size_t i = 0; i < 6; ++i) {
    const ChunkInfo& chunk = whole.value().chunks()[i];
    base::Bytes changed = bytes;
    changed[chunk.offset + chunk.record_bytes - 3] ^= std::byte{1};
    base::Bytes repaired;
    auto report = RepairBytes(changed, &repaired);
    ASSERT_TRUE(report.ok());
    ASSERT_EQ(report.value().losses.size(), 1u);
    EXPECT_NE(report.value().losses[0].find("byte " + std::to_string(chunk.offset) + ": the chunk with the messages"),
              std::string::npos);
    auto reader = McapReader::OpenBytes(repaired);
    EXPECT_EQ(reader.value().Verify(), std::vector<std::string>{});
    EXPECT_EQ(reader.value().statistics().messages, messages_without[i]);
    EXPECT_EQ(reader.value().attachments().size(), 1u);
    for (const Copied& message : ReadAll(reader.value()).messages) {
      EXPECT_TRUE(std::ranges::count(MessagesOf(SmallPlan()), message) == 1);
    }
  }
}

TEST(Repair, WritesTheTargetWholeOrNotAtAll) {
  const fs::path folder = fs::temp_directory_path() / ("rodeira-repair-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const base::Bytes bytes = Record(SmallPlan(), SmallSettings(Compression::kNone));
  ASSERT_TRUE(base::WriteWhole(folder / "cut.mcap", std::span(bytes).first(bytes.size() / 2)).ok());
  ASSERT_TRUE(base::WriteWhole(folder / "other.mcap", "nonsense").ok());

  auto report = Repair(folder / "cut.mcap", folder / "good.mcap");
  ASSERT_TRUE(report.ok()) << report.error().Text();
  EXPECT_EQ(report.value().target_bytes, fs::file_size(folder / "good.mcap"));
  EXPECT_NE(report.value().Text().find("the recording was not closed"), std::string::npos) << report.value().Text();
  EXPECT_NE(report.value().Text().find("kept: "), std::string::npos);
  EXPECT_TRUE(McapReader::Open(folder / "good.mcap").value().condition().whole);

  EXPECT_NE(Repair(folder / "cut.mcap", folder / "good.mcap").error().Text().find("there already"), std::string::npos);
  EXPECT_FALSE(Repair(folder / "other.mcap", folder / "new.mcap").ok());
  EXPECT_FALSE(Repair(folder / "none.mcap", folder / "new.mcap").ok());
  EXPECT_FALSE(Repair(folder / "cut.mcap", folder / "none" / "new.mcap").ok());
  EXPECT_FALSE(fs::exists(folder / "new.mcap"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 3);  // and no ".part"
  fs::remove_all(folder);
}

}  // namespace
}  // namespace rodeira::record

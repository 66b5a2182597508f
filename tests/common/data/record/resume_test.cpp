// SPDX-License-Identifier: Apache-2.0
// Another writer goes on with the recording of one that has died: nothing that was whole is lost, and nothing is
// destroyed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "common/core/base/files.hpp"
#include "tests/common/data/record/sample.hpp"

namespace rodeira::record {
namespace {

namespace fs = std::filesystem;

class ContinuedFile : public testing::Test {
 protected:
  ContinuedFile()
      : folder_(fs::temp_directory_path() / ("rodeira-go-on-" + std::to_string(::getpid()))),
        file_(folder_ / "a.mcap") {
    fs::create_directories(folder_);
  }
  ~ContinuedFile() override { fs::remove_all(folder_); }

  // A message each 10 ns, chunks of 100 ns.
  static WriterSettings Settings() {
    WriterSettings settings;
    settings.chunk_span_ns = 100;
    return settings;
  }
  static base::Status WriteFrom(McapWriter& writer, std::uint32_t from, std::uint32_t until) {
    const auto channel = writer.AddChannel("t", 0, "cdr");
    if (!channel) return channel.error();
    for (std::uint32_t i = from; i < until; ++i) {
      const base::Bytes data(40, static_cast<std::byte>(i));
      if (auto status = writer.Write(channel.value(), i, 10u * i, 10u * i, data); !status) return status;
    }
    return {};
  }
  static base::Status End(McapWriter& writer) {
    if (auto status = writer.AddMetadata("end", {{"last", "one"}}); !status) return status;
    return writer.Close();
  }
  base::Bytes Whole(std::uint32_t messages) const {
    const fs::path path = folder_ / "whole.mcap";
    fs::remove(path);
    auto writer = McapWriter::Open(path, Settings());
    EXPECT_TRUE(WriteFrom(writer.value(), 0, messages).ok() && End(writer.value()).ok());
    return base::ReadBytes(path).value();
  }
  void Put(std::span<const std::byte> bytes) const {
    std::ofstream out(file_, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  base::Result<std::optional<McapWriter>> Go(std::uint64_t least_end_ns) {
    handed_.clear();
    return McapWriter::Resume(file_, Settings(),
                              {1'000'000, least_end_ns, [&](const Channel&, const Message& message) -> base::Status {
                                 handed_.push_back(message.sequence);
                                 return {};
                               }});
  }
  fs::path folder_, file_;
  std::vector<std::uint32_t> handed_;
};

// At every byte where the first writer may have ended, its last one among them: the file becomes that of one writer
// that wrote it all.
TEST_F(ContinuedFile, WhereverTheFirstOneEndedTheFileIsTheSame) {
  const base::Bytes whole = Whole(57);
  int gone_on = 0, closed = 0;
  for (std::size_t size = 0; size <= whole.size(); size += size + 40 < whole.size() ? 13 : 1) {
    SCOPED_TRACE(size);
    Put(std::span(whole).first(size));
    auto writer = Go(0);
    if (!writer.ok()) {
      EXPECT_LT(size, 60u) << "only the header may be lacking: " << writer.error().Text();
      continue;
    }
    if (!writer.value()) {
      EXPECT_EQ(base::ReadBytes(file_).value().size(), size) << "left as it is";
      continue;
    }
    ++gone_on;
    closed += size == whole.size() ? 1 : 0;
    ASSERT_FALSE(handed_.empty());
    ASSERT_TRUE(WriteFrom(*writer.value(), handed_.back() + 1, 57).ok());
    ASSERT_TRUE(End(*writer.value()).ok());
    ASSERT_EQ(base::ReadBytes(file_).value(), whole);
  }
  EXPECT_GT(gone_on, 100);
  EXPECT_EQ(closed, 1) << "its last words were written, but nobody may have heard that";
}

TEST_F(ContinuedFile, WhatWasDamagedMeanwhileIsLeftAsItIs) {
  base::Bytes bytes = Whole(57);
  bytes.resize(bytes.size() - 400);  // it was not closed
  bytes[bytes.size() / 2] ^= std::byte{1};
  Put(bytes);
  const auto refused = Go(500);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().exit_status(), 1);
  EXPECT_THAT(refused.error().Text(), testing::HasSubstr("it was damaged meanwhile"));
  EXPECT_EQ(base::ReadBytes(file_).value(), bytes) << "what lies behind the damage can still be repaired";
  // A caller that may lose what lies there says so.
  const auto taken = Go(0);
  ASSERT_TRUE(taken.ok());
  ASSERT_TRUE(taken.value().has_value());
  EXPECT_LT(handed_.back(), 50u);
}

// As a log's message that comes after later samples have gone to the disk.
TEST_F(ContinuedFile, ALastChunkOfEarlierMessagesIsNoDamage) {
  auto writer = McapWriter::Open(folder_ / "late.mcap", Settings());
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(WriteFrom(writer.value(), 0, 57).ok() && writer.value().Sync().ok());
  const auto log = writer.value().AddChannel("log", 0, "cdr");
  ASSERT_TRUE(log.ok());
  ASSERT_TRUE(writer.value().Write(log.value(), 0, 40, 40, base::Bytes(8)).ok() && writer.value().Sync().ok());
  Put(base::ReadBytes(folder_ / "late.mcap").value());  // before it is closed
  EXPECT_FALSE(Go(561).ok()) << "560 ns is the last message's time";
  const auto gone_on = Go(560);
  ASSERT_TRUE(gone_on.ok()) << gone_on.error().Text();
  ASSERT_TRUE(gone_on.value().has_value());
  EXPECT_EQ(std::ssize(handed_), 58);
}

TEST_F(ContinuedFile, AFileWithoutAChunkHoldsNothing) {
  ASSERT_TRUE(McapWriter::Open(file_, Settings()).ok());
  auto writer = Go(0);
  ASSERT_TRUE(writer.ok());
  EXPECT_FALSE(writer.value().has_value());
  EXPECT_FALSE(Go(1).ok()) << "though something of it was safe";
}

}  // namespace
}  // namespace rodeira::record

// SPDX-License-Identifier: Apache-2.0
// The writer: the same calls give the same bytes, chunks have their bounds, and a failing disk is an Error.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "common/core/base/files.hpp"
#include "tests/common/data/record/sample.hpp"
#include "tests/names.hpp"

namespace rodeira::record {
namespace {

namespace fs = std::filesystem;

class WriterFile : public testing::Test {
 protected:
  WriterFile() : folder_(fs::temp_directory_path() / ("rodeira-record-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~WriterFile() override { fs::remove_all(folder_); }
  fs::path folder_;
};

base::Bytes Numbered(std::size_t size) { return base::Bytes(size, std::byte{0x5A}); }

TEST_F(WriterFile, TwoRunsGiveIdenticalFiles) {
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    for (const char* name : {"a.mcap", "b.mcap"}) {
      WriterSettings settings = SmallSettings(compression);
      settings.overwrite = true;
      auto writer = McapWriter::Open(folder_ / name, settings);
      ASSERT_TRUE(writer.ok()) << writer.error().Text();
      ASSERT_TRUE(Make(writer.value(), SmallPlan()).ok());
      ASSERT_TRUE(writer.value().Close().ok());
      ASSERT_TRUE(writer.value().Close().ok());
    }
    const auto a = base::ReadBytes(folder_ / "a.mcap").value();
    EXPECT_EQ(a, base::ReadBytes(folder_ / "b.mcap").value());
    EXPECT_EQ(a, Record(SmallPlan(), SmallSettings(compression)));
  }
}

TEST_F(WriterFile, AnExistingFileIsRefusedAndKept) {
  std::ofstream(folder_ / "a.mcap") << "precious";
  auto writer = McapWriter::Open(folder_ / "a.mcap");
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(writer.error().Text(),
            (folder_ / "a.mcap").string() + ": the recording cannot be created: a file of that name is there already");
  EXPECT_EQ(writer.error().exit_status(), 2);
  EXPECT_EQ(base::ReadText(folder_ / "a.mcap").value(), "precious");
}

TEST_F(WriterFile, AFileThatIsBeingWrittenIsNotOverwritten) {
  WriterSettings settings;
  settings.overwrite = true;
  auto first = McapWriter::Open(folder_ / "a.mcap", settings);
  ASSERT_TRUE(first.ok());
  const auto before = fs::file_size(folder_ / "a.mcap");
  auto second = McapWriter::Open(folder_ / "a.mcap", settings);
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().id.text(), "recording.in_use");
  EXPECT_EQ(fs::file_size(folder_ / "a.mcap"), before);
}

TEST_F(WriterFile, PlacesThatCannotBeWrittenAreNamed) {
  EXPECT_EQ(McapWriter::Open(folder_ / "none" / "a.mcap").error().Text(),
            (folder_ / "none" / "a.mcap").string() + ": the recording cannot be created: No such file or directory");
  WriterSettings settings;
  settings.overwrite = true;
  EXPECT_EQ(McapWriter::Open(folder_, settings).error().id.text(), "file.cannot_open");
  EXPECT_NE(McapWriter::Open(folder_, settings).error().Text().find("Is a directory"), std::string::npos);
}

TEST(Writer, AFullDeviceIsAnErrorWithPathAndReason) {
  auto writer = McapWriter::Open("/dev/full");
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(writer.error().Text(), "/dev/full: the recording cannot be written: No space left on device");
  EXPECT_EQ(writer.error().exit_status(), 1);
}

// A limit on the size of files: the kernel writes a part of a chunk and then says EFBIG.
TEST_F(WriterFile, AFileThatMayNotGrowKeepsItsCompleteChunks) {
  const fs::path path = folder_ / "limited.mcap";
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit limit { .rlim_cur = 20'000, .rlim_max = before.rlim_max };
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);

  WriterSettings settings;
  settings.compression = Compression::kNone;
  settings.chunk_bytes = 4096;
  auto writer = McapWriter::Open(path, settings);
  base::Status status;
  std::uint64_t written = 0;
  if (writer) {
    const ChannelId channel = writer.value().AddChannel("t", 0, "cdr").value();
    for (std::uint32_t i = 0; i < 1000 && status; ++i) {
      written = writer.value().written_bytes();
      status = writer.value().Write(channel, i, i, i, Numbered(300));
    }
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  ::signal(SIGXFSZ, handler);

  ASSERT_TRUE(writer.ok());
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error(), IsError("recording.cannot_write", path.string() + ": … File too large"));
  EXPECT_EQ(fs::file_size(path), written);  // the torn chunk was cut off
  EXPECT_FALSE(writer.value().Write(1, 0, 0, 0, {}).ok());
  EXPECT_FALSE(writer.value().Close().ok());
  EXPECT_EQ(fs::file_size(path), written);  // nothing more was written, though there would be room again
  auto reader = McapReader::Open(path);
  ASSERT_TRUE(reader.ok());
  const auto messages = ReadAll(reader.value()).messages;
  EXPECT_EQ(messages.size(), 12u * 4u);  // 12 messages of 331 bytes fit in a chunk, 4 such chunks in the limit
  for (std::size_t i = 0; i < messages.size(); ++i) EXPECT_EQ(messages[i].sequence, i);
}

// A disk that is full after any number of bytes.
TEST(Writer, WhereverTheDiskEndsWhatWasCompleteStays) {
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    const WriterSettings settings = SmallSettings(compression);
    const base::Bytes whole = Record(SmallPlan(), settings);
    const auto all = MessagesOf(SmallPlan());
    std::size_t most = 0;
    for (std::uint64_t capacity = 0; capacity < whole.size(); ++capacity) {
      base::Bytes bytes;
      auto writer = McapWriter::Open(std::make_unique<MemorySink>(&bytes, capacity), settings);
      if (!writer) {
        EXPECT_TRUE(bytes.empty());
        continue;
      }
      base::Status status = Make(writer.value(), SmallPlan());
      const base::Status closed = writer.value().Close();
      ASSERT_FALSE(closed.ok());
      EXPECT_EQ(closed.error().code, base::ErrorCode::kFailed);
      if (!status) {
        EXPECT_EQ(status.error().Text(), closed.error().Text());
      }
      EXPECT_EQ(bytes.size(), writer.value().written_bytes());
      ASSERT_TRUE(std::ranges::equal(bytes, std::span(whole).first(bytes.size())));

      auto reader = McapReader::OpenBytes(bytes);
      ASSERT_TRUE(reader.ok());
      EXPECT_FALSE(reader.value().condition().by_summary);
      EXPECT_EQ(reader.value().condition().good_bytes, bytes.size());  // it ends between two records
      Query query;
      query.order = Query::Order::kFile;
      const auto messages = ReadAll(reader.value(), query).messages;
      ASSERT_TRUE(std::ranges::equal(messages, std::span(all).first(messages.size())));
      EXPECT_GE(messages.size(), most);
      most = messages.size();
    }
    EXPECT_EQ(most, all.size());  // with all but the last byte, only the summary is missing
  }
}

TEST_F(WriterFile, WhatWasFlushedSurvivesTheEndOfTheProcess) {
  const fs::path path = folder_ / "killed.mcap";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto writer = McapWriter::Open(path);
    const ChannelId channel = writer.value().AddChannel("t", 0, "cdr").value();
    for (std::uint32_t i = 0; i < 10; ++i) static_cast<void>(writer.value().Write(channel, i, i, i, Numbered(50)).ok());
    static_cast<void>(writer.value().Flush().ok());
    for (std::uint32_t i = 10; i < 20; ++i)
      static_cast<void>(writer.value().Write(channel, i, i, i, Numbered(50)).ok());
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  auto reader = McapReader::Open(path);
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(ReadAll(reader.value()).messages.size(), 10u);
  EXPECT_EQ(reader.value().condition().findings,
            std::vector<std::string>{"the recording was not closed: it does not end with MCAP's mark"});
}

TEST(Writer, AChunkSpansLessThanTheSpanAndHoldsAtMostTheBytes) {
  base::Bytes bytes;
  WriterSettings settings;
  settings.chunk_bytes = 4096;
  auto writer = McapWriter::Open(std::make_unique<MemorySink>(&bytes), settings);
  const ChannelId channel = writer.value().AddChannel("t", 0, "cdr").value();
  for (std::uint32_t i = 0; i < 3000; ++i) {
    ASSERT_TRUE(writer.value().Write(channel, i, i * 10'000'000ull, 0, Numbered(i < 2000 ? 4 : 500)).ok());
  }
  ASSERT_TRUE(writer.value().Close().ok());
  auto reader = McapReader::OpenBytes(bytes);
  std::uint64_t next_ns = 0;
  for (const ChunkInfo& chunk : reader.value().chunks()) {
    EXPECT_LT(chunk.last_log_time_ns - chunk.first_log_time_ns, 1'000'000'000u);
    EXPECT_LE(chunk.uncompressed_bytes, 4096u);
    EXPECT_EQ(chunk.first_log_time_ns, next_ns);
    next_ns = chunk.last_log_time_ns + 10'000'000;
  }
  EXPECT_EQ(reader.value().chunks()[0].last_log_time_ns, 990'000'000u);  // 100 small messages: one second
}

TEST(Writer, AMessageLargerThanAChunkHasItsOwn) {
  base::Bytes bytes;
  WriterSettings settings;
  settings.chunk_bytes = 4096;
  auto writer = McapWriter::Open(std::make_unique<MemorySink>(&bytes), settings);
  const ChannelId channel = writer.value().AddChannel("t", 0, "cdr").value();
  for (const std::size_t size : {10, 50'000, 10}) {
    ASSERT_TRUE(writer.value().Write(channel, 0, 0, 0, Numbered(size)).ok());
  }
  ASSERT_TRUE(writer.value().Close().ok());
  auto reader = McapReader::OpenBytes(bytes);
  EXPECT_EQ(reader.value().chunks().size(), 3u);
  EXPECT_EQ(ReadAll(reader.value()).messages[1].data, Numbered(50'000));
}

TEST(Writer, TheSameSchemaAndChannelAgainIsTheSameId) {
  base::Bytes bytes;
  auto opened = McapWriter::Open(std::make_unique<MemorySink>(&bytes));
  McapWriter& writer = opened.value();
  EXPECT_EQ(writer.AddSchema("a::A", "omgidl", "x").value(), 1);
  EXPECT_EQ(writer.AddSchema("a::B", "omgidl", "x").value(), 2);
  EXPECT_EQ(writer.AddSchema("a::A", "omgidl", "x").value(), 1);
  EXPECT_EQ(writer.AddChannel("t", 1, "cdr").value(), 1);
  EXPECT_EQ(writer.AddChannel("t", 1, "cdr", {{"source", "2"}}).value(), 2);
  EXPECT_EQ(writer.AddChannel("t", 1, "cdr").value(), 1);
  EXPECT_EQ(writer.statistics().schemas, 2);
  EXPECT_EQ(writer.statistics().channels, 2u);
}

TEST(Writer, RefusedCallsChangeNothing) {
  base::Bytes bytes;
  auto opened = McapWriter::Open(std::make_unique<MemorySink>(&bytes));
  McapWriter& writer = opened.value();
  EXPECT_EQ(writer.Write(1, 0, 0, 0, {}).error().id.text(), "recording.wrong_message");
  EXPECT_EQ(writer.AddChannel("t", 1, "cdr").error().Text(), "memory: topic 't': there is no schema 1");
  const ChannelId channel = writer.AddChannel("t", 0, "cdr").value();
  EXPECT_EQ(writer.Write(channel, 0, 0, 0, base::Bytes(kMaxMessageBytes + 1)).error().Text(),
            "memory: topic 't': a message has 67108865 bytes, at most 67108864 were expected");
  EXPECT_NE(writer.AddSchema("a", "b", std::string(17u << 20, 'x')).error().Text().find("more than 16777216 bytes"),
            std::string::npos);
  EXPECT_FALSE(writer.AddMetadata("a", {{"b", std::string(17u << 20, 'x')}}).ok());
  EXPECT_FALSE(writer.AddAttachment("a", "b", base::Bytes(250u << 20), 0, 0).ok());
  ASSERT_TRUE(writer.Write(channel, 0, 1, 1, {}).ok());
  ASSERT_TRUE(writer.Close().ok());
  auto reader = McapReader::OpenBytes(bytes);
  EXPECT_EQ(reader.value().Verify(), std::vector<std::string>{});
  EXPECT_EQ(reader.value().statistics().messages, 1u);
}

TEST(Writer, SettingsOutOfRangeAreRefused) {
  const auto text_of = [](auto change) {
    WriterSettings settings;
    change(settings);
    base::Bytes bytes;
    return McapWriter::Open(std::make_unique<MemorySink>(&bytes), settings).error().Text();
  };
  EXPECT_EQ(text_of([](WriterSettings& s) { s.chunk_span_ns = 1'000'000'001; }),
            "memory: chunk_span_ns is 1000000001, 1 to 1000000000 (one second) was expected");
  EXPECT_EQ(text_of([](WriterSettings& s) { s.chunk_span_ns = 0; }),
            "memory: chunk_span_ns is 0, 1 to 1000000000 (one second) was expected");
  EXPECT_EQ(text_of([](WriterSettings& s) { s.chunk_bytes = 100; }),
            "memory: chunk_bytes is 100, 4096 to 67108864 was expected");
  EXPECT_EQ(text_of([](WriterSettings& s) { s.zstd_level = 20; }),
            "memory: zstd_level is 20, -7 (fastest) to 19 was expected");
}

// MCAP's texts are UTF-8: other readers refuse a file with other texts.
TEST(Writer, TextsThatAreNotUtf8AreConverted) {
  base::Bytes bytes;
  auto writer = McapWriter::Open(std::make_unique<MemorySink>(&bytes));
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(writer.value().AddMetadata("gr\xFC\xDF", {{"k\xE4", "\xE4\xC3\xA4"}}).ok());
  ASSERT_TRUE(writer.value().AddAttachment("f\xFC.yaml", "text/plain", {}, 0, 0).ok());
  ASSERT_TRUE(writer.value().AddChannel("t\xFC", 0, "cdr", {{"source", "\xFF"}}).ok());
  ASSERT_TRUE(writer.value().Close().ok());
  const auto reader = McapReader::OpenBytes(bytes);
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reader.value().FindMetadata("gr\\xfc\\xdf").value()->entries, (TextMap{{"k\\xe4", "\\xe4\xC3\xA4"}}));
  EXPECT_EQ(reader.value().attachments()[0].name, "f\\xfc.yaml");
  EXPECT_EQ(reader.value().channels().at(1).topic, "t\\xfc");
  EXPECT_EQ(reader.value().channels().at(1).metadata, (TextMap{{"source", "\\xff"}}));
}

}  // namespace
}  // namespace rodeira::record

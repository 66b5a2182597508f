// SPDX-License-Identifier: Apache-2.0
// The reference reader's word: what the writer wrote is read and decoded by npm's @mcap/core and @foxglove/omgidl-*.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "common/core/base/files.hpp"
#include "common/data/record/repair.hpp"
#include "tests/common/data/record/probe.hpp"
#include "tests/common/data/record/sample.hpp"
#include "tests/tree.hpp"

namespace rodeira::record {
namespace {

namespace fs = std::filesystem;

const fs::path kChecker = fs::path(SourceDir()) / "tests/record-npm";

struct Outcome {
  int status = -1;
  std::string output;
};

Outcome Execute(const std::string& command) {
  Outcome outcome;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 4096> buffer;
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.output.append(buffer.data(), got);
  const int status = ::pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

Outcome Check(const fs::path& recording, const fs::path& expected = {}) {
  return Execute(fmt::format("node '{}' '{}' {}", (kChecker / "check.mjs").string(), recording.string(),
                             expected.empty() ? "" : "'" + expected.string() + "'"));
}

class Npm : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kChecker / "node_modules/@mcap/core") || std::system("node --version > /dev/null 2>&1") != 0) {
      GTEST_SKIP() << "node or the reference reader is not installed: npm ci --prefix tests/record-npm";
    }
    folder_ = fs::temp_directory_path() / ("rodeira-npm-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  // 200 samples and 50 ticks in two topics over some three seconds, an attachment and metadata; returns the JSON.
  std::string WriteProbe(const fs::path& path, Compression compression, bool stale_padding = false) {
    WriterSettings settings;
    settings.compression = compression;
    auto opened = McapWriter::Open(path, settings);
    EXPECT_TRUE(opened.ok());
    McapWriter& writer = opened.value();
    const ChannelId samples =
        writer.AddChannel("probe/sample", writer.AddSchema("probe::Sample", "omgidl", probe::kIdl).value(), "cdr")
            .value();
    const ChannelId ticks =
        writer
            .AddChannel("probe/tick", writer.AddSchema("probe::Tick", "omgidl", probe::kIdl).value(), "cdr",
                        {{"source", "clock"}})
            .value();
    std::string sample_json;
    std::string tick_json;
    EXPECT_TRUE(writer.AddMetadata("run", {{"seed", "1"}}).ok());
    for (std::uint32_t n = 0; n < 200; ++n) {
      const std::uint64_t time_ns = n * 15'000'000ull;
      base::Bytes data = probe::Encode(probe::MakeSample(n));
      if (stale_padding && n == 7) data[4 + 21] = std::byte{0x55};  // between the octet at 20 and the double at 24
      EXPECT_TRUE(writer.Write(samples, n, time_ns, time_ns, data).ok());
      sample_json += (n > 0 ? "," : "") + probe::Json(probe::MakeSample(n));
      if (n % 4 != 0) continue;
      EXPECT_TRUE(writer.Write(ticks, n, time_ns, time_ns, probe::Encode(probe::MakeTick(n))).ok());
      tick_json += (n > 0 ? "," : "") + probe::Json(probe::MakeTick(n));
    }
    EXPECT_TRUE(writer.AddAttachment("launch.yaml", "text/yaml", base::Bytes(100, std::byte{'x'}), 5, 6).ok());
    EXPECT_TRUE(writer.Close().ok());
    return fmt::format(R"({{"probe/sample":[{}],"probe/tick":[{}]}})", sample_json, tick_json);
  }

  fs::path folder_;
};

TEST_F(Npm, TheReferenceReaderReadsAndDecodesEverything) {
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    const fs::path path = folder_ / (compression == Compression::kZstd ? "zstd.mcap" : "none.mcap");
    const fs::path expected = folder_ / "expected.json";
    std::ofstream(expected) << WriteProbe(path, compression);
    const Outcome outcome = Check(path, expected);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    for (const char* line :
         {"topic probe/sample (probe::Sample): 200 messages", "topic probe/tick (probe::Tick): 50 messages",
          "attachment launch.yaml: 100 bytes", "metadata run: 1 entries"}) {
      EXPECT_NE(outcome.output.find(line), std::string::npos) << outcome.output;
    }
  }
}

TEST_F(Npm, TheCheckFails) {
  const fs::path path = folder_ / "good.mcap";
  std::string json = WriteProbe(path, Compression::kZstd);
  const auto refused = [&](const std::string& sentence, const Outcome& outcome) {
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_NE(outcome.output.find(sentence), std::string::npos) << outcome.output;
  };
  // Another value than was written.
  const std::size_t at = json.find("\"small\":") + 8;
  json.replace(at, json.find(',', at) - at, "1000");
  std::ofstream(folder_ / "other.json") << json;
  refused("topic probe/sample, message 0: ", Check(path, folder_ / "other.json"));
  // A damaged chunk; a recording cut short.
  base::Bytes bytes = base::ReadBytes(path).value();
  ASSERT_TRUE(base::WriteWhole(folder_ / "cut.mcap", std::span(bytes).first(bytes.size() - 1)).ok());
  refused("problem: ", Check(folder_ / "cut.mcap"));
  const ChunkInfo chunk = McapReader::Open(path).value().chunks()[1];
  bytes[chunk.offset + chunk.record_bytes - 20] ^= std::byte{1};
  ASSERT_TRUE(base::WriteWhole(folder_ / "changed.mcap", bytes).ok());
  refused("problem: ", Check(folder_ / "changed.mcap"));
  // Rubbish in the padding.
  WriteProbe(folder_ / "stale.mcap", Compression::kNone, true);
  refused("message 7 at 105000000 ns: byte 25 is 85, encoded again it is 0", Check(folder_ / "stale.mcap"));
}

TEST_F(Npm, OddRecordingsAreReadToo) {
  // Messages out of order, chunks that overlap, chunks without messages, no messages at all.
  const auto check = [&](const std::vector<Call>& calls, const char* name) {
    ASSERT_TRUE(base::WriteWhole(folder_ / name, Record(calls, SmallSettings(Compression::kZstd))).ok());
    const Outcome outcome = Check(folder_ / name);
    // The sample's payloads are no CDR: only the container is asked about here.
    for (const char* bad : {"CRC", "index", "statistics", "left over", "checksum", "summary", "Error"}) {
      EXPECT_EQ(outcome.output.find(bad), std::string::npos) << name << ": " << outcome.output;
    }
    EXPECT_NE(outcome.output.find("topic events (probe::Type2)"), std::string::npos) << outcome.output;
  };
  check(SmallPlan(), "small.mcap");
  check({}, "empty.mcap");
  check({{Call::Kind::kFlush, 0, 0, 0}, {Call::Kind::kMessage, 1, 7, 8}}, "late.mcap");
}

// The reference writer, with every combination of its options: all is read, and repair keeps all of it.
TEST_F(Npm, WhatTheReferenceWriterWritesIsReadWhole) {
  const Outcome made = Execute(fmt::format("node '{}' '{}'", (kChecker / "write.mjs").string(), folder_.string()));
  ASSERT_EQ(made.status, 0) << made.output;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    SCOPED_TRACE(entry.path().filename().string());
    ++files;
    const auto opened = McapReader::Open(entry.path());
    ASSERT_TRUE(opened.ok()) << opened.error().Text();
    const McapReader& reader = opened.value();
    EXPECT_TRUE(reader.condition().whole);
    EXPECT_EQ(reader.condition().findings, std::vector<std::string>{});
    EXPECT_EQ(reader.Verify(), std::vector<std::string>{});
    const Read read = ReadAll(reader);
    EXPECT_EQ(read.errors, std::vector<std::string>{});
    ASSERT_EQ(read.messages.size(), 60u);
    for (std::size_t i = 0; i < read.messages.size(); ++i) {  // as write.mjs says
      const Copied& message = read.messages[i];
      EXPECT_EQ(message.topic, i % 3 == 0 ? "/slow" : "/fast");
      EXPECT_EQ(message.log_time_ns, 100'000'000 * i);
      const std::string text = fmt::format("{{\"n\":{}}}", i);
      EXPECT_TRUE(std::ranges::equal(message.data, std::as_bytes(std::span(text))));
    }
    EXPECT_EQ(reader.attachments().size(), 1u);
    EXPECT_EQ(reader.FindMetadata("about").value()->entries, (TextMap{{"key", "value"}}));
    const fs::path repaired = entry.path().string() + ".repaired";
    const auto report = Repair(entry.path(), repaired);
    ASSERT_TRUE(report.ok()) << report.error().Text();
    EXPECT_TRUE(report.value().was_whole) << report.value().Text();
    EXPECT_FALSE(report.value().lost);
    EXPECT_EQ(ReadAll(McapReader::Open(repaired).value()).messages, read.messages);
    fs::remove(repaired);
  }
  EXPECT_EQ(files, 3u * 256u);
}

}  // namespace
}  // namespace rodeira::record

// SPDX-License-Identifier: Apache-2.0
// `info` and `repair` of other programs' recordings and of one that is being written; output to a full disk.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/base/files.hpp"
#include "launch/rodeira/commands/info_command.hpp"
#include "launch/rodeira/commands/repair_command.hpp"
#include "launch/rodeira/replay/recording_text.hpp"
#include "tests/common/data/record/foreign.hpp"
#include "tests/launch/rodeira/said.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

using record::ForeignRecord;
using record::Form;
using record::MessagesOf;
using record::SmallPlan;
using system_test::Bin;
using system_test::RunCommand;
using ::testing::HasSubstr;
using ::testing::Not;

class RecordingCommands : public ::testing::Test {
 protected:
  std::string Path(const char* name) const { return (folder_.path() / name).string(); }
  void Write(const char* name, const base::Bytes& bytes) const {
    ASSERT_TRUE(base::WriteWhole(Path(name), bytes).ok());
  }
  static Said InfoOf(const std::string& file) { return SaidBy<std::string>(Info, file); }
  Said Repair(const char* from, const char* to) const {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = RepairRecording(Path(from), Path(to));
    return {status, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
  }
  TemporaryFolder folder_;
};

TEST_F(RecordingCommands, LegalFilesOfOtherProgramsAreWhole) {
  Form outside;
  outside.messages_a_chunk = 0;
  Form lz4;
  lz4.compression = "lz4";
  Form bare;
  bare.schemas = bare.channels = bare.statistics = bare.chunk_indexes = bare.attachment_indexes = false;
  bare.metadata_indexes = bare.summary_offsets = false;
  Form no_statistics;
  no_statistics.statistics = false;
  Form no_chunk_index;
  no_chunk_index.chunk_indexes = false;
  for (const Form& form : {Form(), outside, lz4, bare, no_statistics, no_chunk_index}) {
    SCOPED_TRACE(Text(form));
    Write("a.mcap", ForeignRecord(SmallPlan(), form));
    const Said info = InfoOf(Path("a.mcap"));
    EXPECT_EQ(info.status, 0) << info.out;
    EXPECT_THAT(info.out, HasSubstr(", whole"));
    EXPECT_THAT(info.out, HasSubstr(fmt::format(" {} samples in ", MessagesOf(SmallPlan()).size())));
    EXPECT_THAT(info.out, Not(HasSubstr("damage")));
    const Said repaired = Repair("a.mcap", "b.mcap");
    EXPECT_EQ(repaired.status, 0) << repaired.out;
    EXPECT_THAT(repaired.out, HasSubstr(fmt::format("kept: {} messages", MessagesOf(SmallPlan()).size())));
    EXPECT_EQ(InfoOf(Path("b.mcap")).status, 0);
    std::filesystem::remove(Path("b.mcap"));
  }
}

TEST_F(RecordingCommands, ALossIsNoSuccess) {
  Form outside;
  outside.messages_a_chunk = 0;
  base::Bytes bytes = ForeignRecord(SmallPlan(), outside);
  bytes.resize(bytes.size() / 2);
  Write("cut.mcap", bytes);
  const Said cut = Repair("cut.mcap", "b.mcap");
  EXPECT_EQ(cut.status, 1) << cut.out;
  EXPECT_THAT(cut.out, HasSubstr("everything is lost"));
  EXPECT_EQ(InfoOf(Path("b.mcap")).status, 0);
}

TEST_F(RecordingCommands, ARecordingThatIsBeingWrittenIsToldAsThat) {
  auto writer = record::McapWriter::Open(Path("a.mcap"));
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(record::Make(writer.value(), SmallPlan()).ok());
  ASSERT_TRUE(writer.value().Flush().ok());
  const Said open = InfoOf(Path("a.mcap"));
  EXPECT_EQ(open.status, 1);
  EXPECT_THAT(open.out, HasSubstr(", being written\n"));
  EXPECT_THAT(open.out, HasSubstr("9 samples in "));
  EXPECT_THAT(open.out, Not(HasSubstr("damage")));
  EXPECT_THAT(open.out, Not(HasSubstr("repair")));
  ASSERT_TRUE(writer.value().Close().ok());
  const Said closed = InfoOf(Path("a.mcap"));
  EXPECT_EQ(closed.status, 0);
  EXPECT_THAT(closed.out, HasSubstr(", whole\n"));
}

TEST_F(RecordingCommands, ATruncatedOneIsNotWholeAndARemovedOneIsNotThere) {
  base::Bytes bytes = ForeignRecord(SmallPlan(), Form());
  bytes.resize(bytes.size() - 100);
  Write("a.mcap", bytes);
  const Said cut = InfoOf(Path("a.mcap"));
  EXPECT_EQ(cut.status, 1);
  EXPECT_THAT(cut.out, HasSubstr(", not whole\n"));
  EXPECT_THAT(cut.out, HasSubstr("what to do: rodeira repair"));
  EXPECT_THAT(WrittenFile(Path("a.mcap"), 3.0), HasSubstr("lost    its end"));
  std::filesystem::remove(Path("a.mcap"));
  const Said gone = InfoOf(Path("a.mcap"));
  EXPECT_EQ(gone.status, 2);
  EXPECT_THAT(gone.errors, HasSubstr("no such file"));
  EXPECT_THAT(WrittenFile(Path("a.mcap"), 3.0), HasSubstr("no such file: it was removed"));
  EXPECT_EQ(WrittenFile("", 3.0), "") << "nothing was recorded";
}

// /dev/full is a disk that is full. Short output is written when the program ends, long output before.
TEST_F(RecordingCommands, OutputToAFullDiskIsAFailure) {
  auto writer = record::McapWriter::Open(Path("a.mcap"));
  ASSERT_TRUE(writer.ok());
  for (int topic = 0; topic < 300; ++topic) {
    ASSERT_TRUE(writer.value().AddChannel(fmt::format("topic/{:0100}", topic), 0, "cdr").ok());
  }
  ASSERT_TRUE(writer.value().Close().ok());
  for (const std::string& words :
       {"info " + Path("a.mcap"), std::string("run --list"), std::string("--version"), std::string("run --help")}) {
    const auto full = RunCommand({"/bin/bash", "-c", Bin("rodeira") + " " + words + " >/dev/full"});
    EXPECT_EQ(full.status, 1) << words << full.out;
    EXPECT_THAT(full.out, HasSubstr("rodeira: cannot write to standard output")) << words;
    EXPECT_EQ(RunCommand({"/bin/bash", "-c", Bin("rodeira") + " " + words + " >/dev/null"}).status, 0) << words;
  }
}

}  // namespace
}  // namespace rodeira::cli

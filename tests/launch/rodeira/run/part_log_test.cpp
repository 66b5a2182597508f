// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/part_log.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "common/core/base/files.hpp"
#include "launch/rodeira/run/failure_report.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class PartLogTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(::pipe2(ends_, O_CLOEXEC | O_NONBLOCK), 0);
    log_ = std::make_unique<PartLog>("traffic", folder_.path() / "logs");
  }
  void TearDown() override {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  // What is printed meanwhile.
  std::string Write(const std::string& text) {
    ::testing::internal::CaptureStderr();
    for (std::size_t at = 0; at < text.size(); at += 4000) {
      const std::string part = text.substr(at, 4000);
      EXPECT_EQ(::write(ends_[1], part.data(), part.size()), static_cast<ssize_t>(part.size()));
      log_->Read(ends_[0]);
    }
    return ::testing::internal::GetCapturedStderr();
  }
  std::string File(const std::string& name = "traffic.log") const {
    const auto text = base::ReadText(folder_.path() / "logs" / name, 8u << 20);
    return text.ok() ? text.value() : "";
  }

  TemporaryFolder folder_;
  int ends_[2] = {-1, -1};
  std::unique_ptr<PartLog> log_;
};

TEST_F(PartLogTest, LinesArePrintedKeptAndWrittenWithTimeAndLevel) {
  EXPECT_EQ(Write("rodeira: node 'traffic': warning: a lane is nar"), "");  // an unfinished line waits
  EXPECT_EQ(Write("row\nrodeira: it failed\nsome library's text\nrest"),
            "rodeira: node 'traffic': warning: a lane is narrow\nrodeira: it failed\nsome library's text\n");
  ::testing::internal::CaptureStderr();
  log_->Finish();
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "rest\n");
  EXPECT_THAT(log_->last_lines(), ElementsAre("rodeira: node 'traffic': warning: a lane is narrow",
                                              "rodeira: it failed", "some library's text", "rest"));
  const std::string time = "[0-9-]+T[0-9:.]+[+-][0-9:]+ ";
  EXPECT_THAT(File(), MatchesRegex(time + "warning  rodeira: node 'traffic': warning: a lane is narrow\n" + time +
                                   "error    rodeira: it failed\n" + time + "info     some library's text\n" + time +
                                   "info     rest\n"));
}

TEST_F(PartLogTest, ABacktraceIsKeptButNotPrinted) {
  const std::string frame = "/usr/libexec/rodeira/rodeira-traffic(+0x49075c)[0x55ca3268975c]";
  EXPECT_EQ(Write("rodeira: crash: SIGSEGV; backtrace:\n" + frame + "\n(a text [with] brackets]\n"),
            "(a text [with] brackets]\n");
  EXPECT_EQ(log_->last_lines().size(), 3u);
  EXPECT_THAT(File(), AllOf(HasSubstr("critical rodeira: crash: SIGSEGV"), HasSubstr(frame)));
}

// What a PC is short of ends several parts of a run.
TEST_F(PartLogTest, WhatAPcIsShortOfIsPrintedOnceForAllParts) {
  constexpr const char* kSentence =
      ": no further thread can be started (ulimit -u, the container's limit of "
      "processes, memory); `rodeira repair` completes a recording\n";
  const auto told = std::make_shared<bool>(false);
  log_ = std::make_unique<PartLog>("traffic", folder_.path() / "logs", told);
  EXPECT_EQ(Write(std::string("rodeira-traffic") + kSentence), std::string("rodeira-traffic") + kSentence);
  log_ = std::make_unique<PartLog>("road", folder_.path() / "logs", told);
  EXPECT_EQ(Write(std::string("rodeira-road") + kSentence + "rodeira: it failed\n"), "rodeira: it failed\n");
  EXPECT_THAT(File("road.log"), HasSubstr("no further thread"));
}

TEST_F(PartLogTest, RemembersTheForeignCodeOfACrashUntilTheNextProcess) {
  (void)Write("rodeira: crash: SIGSEGV; backtrace:\n");
  EXPECT_EQ(log_->crash_place(), "");
  (void)Write("rodeira: crash: SIGBUS in fmi2DoStep of FMU '/a in b/car.fmu' (instance 'ego'); backtrace:\n");
  EXPECT_EQ(log_->crash_place(), "fmi2DoStep of FMU '/a in b/car.fmu' (instance 'ego')");
  (void)Write("rodeira: crash: exit in fmi2DoStep of FMU 'c.fmu'\n");
  EXPECT_EQ(log_->crash_place(), "fmi2DoStep of FMU 'c.fmu'");
  log_->ForgetEnd();
  EXPECT_EQ(log_->crash_place(), "");
}

TEST_F(PartLogTest, TheLastWordOfANodeIsKeptUntilTheNextProcessButNotPrinted) {
  EXPECT_EQ(log_->LastWordOf("traffic"), "");
  EXPECT_EQ(Write("rodeira: more\nrodeira: end: refused 0 a.yaml:3: unknown key 'x'\n"), "rodeira: more\n");
  EXPECT_EQ(log_->LastWordOf("traffic"), "refused 0 a.yaml:3: unknown key 'x'");
  EXPECT_THAT(File(), HasSubstr("rodeira: end: refused 0 a.yaml:3: unknown key 'x'\n"));
  log_->ForgetEnd();
  EXPECT_EQ(log_->LastWordOf("traffic"), "");
}

// Nodes that share a process have one log.
TEST_F(PartLogTest, OfASharedProcessEachNodesLastWordAndTheOneThatCrashedAreKnown) {
  EXPECT_EQ(Write("rodeira: end of node 'a': lost 7 it's: over\nrodeira: end of node 'b c': refused 0 wrong\n"
                  "rodeira: crash: node 'a'\nrodeira: crash: SIGSEGV; backtrace:\n"),
            "");
  EXPECT_EQ(log_->LastWordOf("a"), "lost 7 it's: over");
  EXPECT_EQ(log_->LastWordOf("b c"), "refused 0 wrong");
  EXPECT_EQ(log_->LastWordOf("b"), "");
  EXPECT_EQ(log_->crash_node(), "a");
  EXPECT_EQ(log_->crash_place(), "");
  log_->ForgetEnd();
  EXPECT_EQ(log_->LastWordOf("a"), "");
  EXPECT_EQ(log_->crash_node(), "");
}

// A run that is refused leaves nothing.
TEST_F(PartLogTest, ALastWordAloneMakesNoFile) {
  EXPECT_EQ(Write("rodeira: end: refused 0 a.yaml:3: unknown key 'x'\n"), "");
  EXPECT_EQ(log_->LastWordOf("traffic"), "refused 0 a.yaml:3: unknown key 'x'");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "logs"));
}

TEST_F(PartLogTest, FilesAreRotatedAndOldLinesForgotten) {
  std::string text;
  for (int i = 0; i < 60'000; ++i) text += "line " + std::to_string(i) + " of a part that writes far too much text\n";
  (void)Write(text);
  EXPECT_EQ(log_->last_lines().size(), PartLog::kLastLines);
  EXPECT_THAT(log_->last_lines().back(), HasSubstr("line 59999"));
  std::size_t files = 0;
  for (const auto& file : fs::directory_iterator(folder_.path() / "logs")) {
    ++files;
    EXPECT_LE(file.file_size(), 1u << 20);
  }
  EXPECT_EQ(files, 4u);  // and three older ones
  EXPECT_THAT(File(), HasSubstr("line 59999"));
}

TEST_F(PartLogTest, NothingIsCreatedWithoutALine) {
  log_->Read(ends_[0]);
  log_->Finish();
  EXPECT_FALSE(fs::exists(folder_.path() / "logs"));
}

TEST_F(PartLogTest, AFolderThatCannotBeMadeLosesOnlyTheFile) {
  (void)folder_.Write("logs", "a file");
  EXPECT_EQ(Write("a line\n"), "a line\n");
  EXPECT_THAT(log_->last_lines(), ElementsAre("a line"));
}

TEST_F(PartLogTest, TheReportHasWhatIsKnownOfTheFailure) {
  (void)Write("rodeira: it failed\n");
  const auto launch = launch::Launch::Load(SourceDir() + "/launch/empty.yaml", {{"seed", "7"}});
  ASSERT_TRUE(launch.ok());
  const std::string text =
      FailureText("node 'b' was killed", launch.value(),
                  {{"clock", "left with status 1", nullptr}, {"traffic", "was killed", log_.get()}});
  EXPECT_THAT(text, AllOf(HasSubstr("fault       node 'b' was killed\n"), HasSubstr("rodeira     "),
                          HasSubstr("changed     seed=7\n"), HasSubstr("part        clock: left with status 1\n"),
                          HasSubstr("== last lines of traffic ==\nrodeira: it failed\n"),
                          Not(HasSubstr("last lines of clock")), HasSubstr("rodeira: launch/1")));
  EXPECT_EQ(FailureFile("/a/drive.mcap", "x"), fs::path("/a/drive-failure.txt"));
}

}  // namespace
}  // namespace rodeira::cli

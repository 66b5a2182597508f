// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/supervisor_pipe.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace rodeira::dds {
namespace {

class SupervisorPipeTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(::pipe(ends_), 0); }
  void TearDown() override {
    for (const int end : ends_) {
      if (end >= 0) ::close(end);
    }
  }
  void Write(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t wrote = ::write(ends_[1], text.data() + done, text.size() - done);
      ASSERT_GT(wrote, 0);
      done += static_cast<std::size_t>(wrote);
    }
  }
  // For Listen.
  std::function<void()> Notify() {
    return [this] {
      const std::lock_guard lock(mutex_);
      ++lines_;
      came_.notify_all();
    };
  }
  // The commands through `last`, once it is there.
  std::vector<std::string> CommandsThrough(SupervisorPipe& pipe, const std::string& last) {
    std::vector<std::string> commands;
    std::unique_lock lock(mutex_);
    for (int seen = 0; commands.empty() || commands.back() != last;) {
      if (!came_.wait_for(lock, std::chrono::seconds(10), [&] { return lines_ != seen; })) break;
      seen = lines_;
      for (std::string& command : pipe.TakeCommands()) commands.push_back(std::move(command));
    }
    return commands;
  }
  std::mutex mutex_;
  std::condition_variable came_;
  int lines_ = 0;
  int ends_[2] = {-1, -1};
};

TEST_F(SupervisorPipeTest, KnowsWhenTheOtherEndIsClosed) {
  SupervisorPipe pipe;
  ASSERT_TRUE(pipe.Listen(ends_[0], Notify()).ok());
  Write("do 1 pause\n");
  EXPECT_EQ(CommandsThrough(pipe, "1 pause"), std::vector<std::string>{"1 pause"});
  EXPECT_FALSE(pipe.is_closed());
  ::close(ends_[1]);
  ends_[1] = -1;
  std::unique_lock lock(mutex_);
  EXPECT_TRUE(came_.wait_for(lock, std::chrono::seconds(10), [&] { return lines_ == 2; }));
  EXPECT_TRUE(pipe.is_closed());
}

TEST_F(SupervisorPipeTest, TakesTheLinesThatCountHoweverTheyCome) {
  SupervisorPipe pipe;
  ASSERT_TRUE(pipe.Listen(ends_[0], Notify()).ok());
  EXPECT_FALSE(pipe.is_waiting());
  const std::string text =
      "do 1 pause\nlost ego 3 a reason of words (9)\nnonsense\nlost\nlost x\nlost x y z\nlost road 0\n\n"
      "said view 1 refused 12 a sentence: it is  whole\nsaid\nsaid view 1 running 2 x\nsaid view 1 failed x y\n"
      "said view 1 failed -1 y\nsaid view 2 lost 3 \n"
      "do 2 mark a b  c\n";
  for (const char one : text) Write(std::string(1, one));
  EXPECT_EQ(CommandsThrough(pipe, "2 mark a b  c"), (std::vector<std::string>{"1 pause", "2 mark a b  c"}));
  const std::vector<LostNode> lost = pipe.TakeLost();
  ASSERT_EQ(lost.size(), 2u);
  EXPECT_EQ(lost[0].node, "ego");
  EXPECT_EQ(lost[0].incarnation, 3u);
  EXPECT_EQ(lost[0].text, "a reason of words (9)");
  EXPECT_EQ(lost[1].text, "was lost");
  const std::vector<LastWord> words = pipe.TakeLastWords();
  ASSERT_EQ(words.size(), 2u);
  EXPECT_EQ(words[0].node, "view");
  EXPECT_EQ(words[0].incarnation, 1u);
  EXPECT_EQ(words[0].phase, lockstep::Phase::kRefused);
  EXPECT_EQ(words[0].step, 12);
  EXPECT_EQ(words[0].text, "a sentence: it is  whole");
  EXPECT_EQ(words[1].phase, lockstep::Phase::kLost);
  EXPECT_EQ(words[1].text, "");
  EXPECT_FALSE(pipe.must_abort());
  Write("abort\ndo 3 stop\n");
  (void)CommandsThrough(pipe, "3 stop");
  EXPECT_TRUE(pipe.must_abort());
}

TEST_F(SupervisorPipeTest, ALineWithoutAnEndIsDroppedAndTheNextOneCounts) {
  SupervisorPipe pipe;
  ASSERT_TRUE(pipe.Listen(ends_[0], Notify()).ok());
  for (int i = 0; i < 400; ++i) Write(std::string(4096, 'x'));
  Write("\ndo 1 stop\n");
  EXPECT_EQ(CommandsThrough(pipe, "1 stop").back(), "1 stop");
}

// What a process writes at its end is read back as it is, but for ends of lines.
TEST_F(SupervisorPipeTest, TheLastWordOfANodeIsOneLine) {
  lockstep::Report report;
  report.progress = 7;
  for (const auto phase : {lockstep::Phase::kRunning, lockstep::Phase::kFinished, lockstep::Phase::kAborted}) {
    report.phase = phase;
    ::testing::internal::CaptureStderr();
    WriteLastWord(report);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "no word of an end that another part has caused";
  }
  report.message = "two\nlines";
  for (const auto phase : {lockstep::Phase::kFailed, lockstep::Phase::kRefused, lockstep::Phase::kLost}) {
    report.phase = phase;
    ::testing::internal::CaptureStderr();
    WriteLastWord(report);
    const std::string line = ::testing::internal::GetCapturedStderr();
    ASSERT_TRUE(line.starts_with(kLastWord) && line.ends_with("\n")) << line;
    const auto word = ParseLastWord("ego 3 " + line.substr(kLastWord.size(), line.size() - kLastWord.size() - 1));
    ASSERT_TRUE(word) << line;
    EXPECT_EQ(word->phase, phase);
    EXPECT_EQ(word->step, 7);
    EXPECT_EQ(word->incarnation, 3u);
    EXPECT_EQ(word->text, "two lines");
  }
}

// The thread has ended when the pipe is gone, whatever it was about to call.
TEST_F(SupervisorPipeTest, EndsItsThreadWhileLinesCome) {
  for (int i = 0; i < 200; ++i) {
    auto calls = std::make_unique<std::atomic<int>>(0);
    {
      SupervisorPipe pipe;
      ASSERT_TRUE(pipe.Listen(ends_[0], [&calls] { ++*calls; }).ok());
      Write("do 1 pause\n");
    }
    calls.reset();
  }
}

}  // namespace
}  // namespace rodeira::dds

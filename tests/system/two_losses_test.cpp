// SPDX-License-Identifier: Apache-2.0
// Two or three parts of a run are lost shortly one after the other, the clock among them: all are started again, and no
// bit changes. RODEIRA_PAIRS says how many runs (2), RODEIRA_PAIRS_SEED repeats a sequence.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <random>
#include <thread>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

struct Loss {
  std::string part;
  int signal = 0;
  std::chrono::milliseconds at{0};
};

constexpr std::array<const char*, 5> kParts = {"clock", "road", "driver", "ego", "recorder"};
constexpr std::array<int, 4> kSignals = {SIGKILL, SIGSEGV, SIGTERM, SIGSTOP};

// Two losses, in one of three cases three; the clock is never told to end, which is an orderly stop.
std::vector<Loss> Draw(std::uint64_t seed) {
  std::mt19937_64 lot(seed);
  std::vector<Loss> losses(lot() % 3 == 0 ? 3 : 2);
  std::chrono::milliseconds at(200 + lot() % 800);
  for (Loss& loss : losses) {
    loss.part = kParts[lot() % kParts.size()];
    do loss.signal = kSignals[lot() % kSignals.size()];
    while (loss.part == "clock" && loss.signal == SIGTERM);
    loss.at = at;
    at += std::chrono::milliseconds(lot() % 2 == 0 ? lot() % 500 : lot() % 3000);
  }
  return losses;
}

std::string TextOf(const std::vector<Loss>& losses) {
  std::string text;
  for (const Loss& loss : losses)
    text += fmt::format("{}/{}@{:.3f} ", loss.part, ::sigabbrev_np(loss.signal),
                        static_cast<double>(loss.at.count()) / 1e3);
  return text;
}

TEST(TwoLosses, WithinSecondsNothingIsLost) {
  const cli::TemporaryFolder folder;
  const auto file = [&](const std::string& name) { return (folder.path() / name).string(); };
  const Ended calm = RunCommand({Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--for", "10", "--in-process",
                                 "--record", file("calm.mcap")});
  ASSERT_EQ(calm.status, 0) << calm.out;
  const auto samples = SamplesOf(file("calm.mcap"));
  const std::uint64_t first = Setting("RODEIRA_PAIRS_SEED", 1);
  for (std::uint64_t n = 0; n < Setting("RODEIRA_PAIRS", 2); ++n) {
    const std::vector<Loss> losses = Draw(first + n);
    const std::string what = fmt::format("RODEIRA_PAIRS_SEED={}: {}", first + n, TextOf(losses));
    const std::string name = fmt::format("losses-{}-{}", ::getpid(), n), recording = file(name + ".mcap");
    Started run({Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--run", name, "--pace", "2", "--for", "10",
                 "--record", recording, "--set", "recovery=restart"});
    ASSERT_TRUE(Runs(name)) << what;
    const auto begin = std::chrono::steady_clock::now();
    for (const Loss& loss : losses) {
      std::this_thread::sleep_until(begin + loss.at);
      for (const pid_t victim :
           ProcessesWith("--run " + name, loss.part == "clock" ? "/rodeira-clock" : "--node " + loss.part))
        ::kill(victim, loss.signal);
    }
    const Ended ended = run.Wait(90s);
    ASSERT_EQ(ended.status, 0) << what << "\n" << ended.out;
    EXPECT_EQ(DigestIn(ended.out), DigestIn(calm.out)) << what << "\n" << ended.out;
    EXPECT_EQ(FirstDifference(samples, SamplesOf(recording)), "") << what << "\n" << ended.out;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 40s) << what << "\n" << ended.out;
    EXPECT_TRUE(ProcessesWith("--run " + name).empty()) << what;
  }
}

}  // namespace
}  // namespace rodeira::system_test

// SPDX-License-Identifier: Apache-2.0
// Two or three parts of the demo are lost within seconds, the clock among them: all are started again, and no bit
// changes. RODEIRA_PAIRS and RODEIRA_TRIPLES say how many runs (2, 1); 49 numbers in sequence have every pair of parts
// once, each in both orders. RODEIRA_PAIRS_SEED and RODEIRA_TRIPLES_SEED say the first number, RODEIRA_PAIRS_FILE and
// RODEIRA_TRIPLES_FILE name a file that keeps the next one, for a sequence that was cancelled.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
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

constexpr std::array<const char*, 7> kParts = {"clock", "road", "driver", "ego", "traffic", "recorder", "view"};
constexpr std::array<int, 4> kSignals = {SIGKILL, SIGSEGV, SIGTERM, SIGSTOP};

// Number `seed` of a sequence in which each part is lost after each part, up to three seconds later.
std::vector<Loss> Draw(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 rng(seed);
  constexpr std::uint64_t kPairs = kParts.size() * kParts.size();
  const std::uint64_t pair = seed * 20 % kPairs;  // neighbours in the sequence have little in common
  std::vector<Loss> losses;
  std::chrono::milliseconds at(200 + rng() % 800);
  for (std::size_t i = 0; i < count; ++i) {
    Loss& loss = losses.emplace_back();
    loss.part = kParts[i == 0 ? pair / kParts.size() : i == 1 ? pair % kParts.size() : rng() % kParts.size()];
    // A clock that is told to end stops the run in order.
    do loss.signal = kSignals[rng() % kSignals.size()];
    while (loss.part == "clock" && loss.signal == SIGTERM);
    loss.at = at;
    at += std::chrono::milliseconds(rng() % 2 == 0 ? rng() % 500 : rng() % 3000);
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

class TwoLosses : public testing::Test {
 protected:
  void SetUp() override {
    const Ended calm = RunCommand(Command("calm", "max"));
    ASSERT_EQ(calm.status, 0) << calm.out;
    digest_ = DigestIn(calm.out);
    samples_ = SamplesOf(File("calm"));
  }
  // `setting`: PAIRS, and so on.
  void RunSequence(const std::string& setting, std::uint64_t runs, std::size_t losses) {
    const char* file = std::getenv(("RODEIRA_" + setting + "_FILE").c_str());
    std::uint64_t number = Setting(("RODEIRA_" + setting + "_SEED").c_str(), 1);
    if (file != nullptr) std::ifstream(file) >> number;
    for (const std::uint64_t end = number + runs; number < end && !HasFatalFailure();) {
      RunWith(Draw(number, losses), fmt::format("RODEIRA_{}_SEED={}: ", setting, number));
      ++number;
      if (file != nullptr) std::ofstream(file) << number << "\n";
    }
  }

 private:
  std::string File(const std::string& name) const { return (folder_.path() / (name + ".mcap")).string(); }
  std::vector<std::string> Command(const std::string& name, const std::string& pace) const {
    return {Bin("rodeira"),
            "run",
            LaunchFile("demo.yaml"),
            "--headless",
            "--run",
            fmt::format("losses-{}-{}", ::getpid(), name),
            "--pace",
            pace,
            "--for",
            "10",
            "--record",
            File(name),
            "--set",
            "recovery=restart",
            "--set",
            "nodes.view.config={width_px: 160, height_px: 96, quality: low, frames: {times_s: [5]}}"};
  }
  void RunWith(const std::vector<Loss>& losses, const std::string& number) {
    const std::string what = number + TextOf(losses), run_name = fmt::format("losses-{}-struck", ::getpid());
    SCOPED_TRACE(what);
    std::filesystem::remove(File("struck"));
    Started run(Command("struck", "2"));
    ASSERT_TRUE(Runs(run_name)) << run.Wait(0s).out;
    const auto begin = std::chrono::steady_clock::now();
    for (const Loss& loss : losses) {
      std::this_thread::sleep_until(begin + loss.at);
      for (const pid_t victim :
           ProcessesWith("--run " + run_name, loss.part == "clock" ? "/rodeira-clock" : "--node " + loss.part))
        ::kill(victim, loss.signal);
    }
    const Ended ended = run.Wait(120s);
    ASSERT_EQ(ended.status, 0) << ended.out;
    EXPECT_EQ(DigestIn(ended.out), digest_) << ended.out;
    EXPECT_EQ(FirstDifference(samples_, SamplesOf(File("struck"))), "") << ended.out;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 60s) << ended.out;
    EXPECT_TRUE(ProcessesWith("--run " + run_name).empty());
  }
  const cli::TemporaryFolder folder_;
  std::string digest_;
  std::vector<Recorded> samples_;
};

TEST_F(TwoLosses, OfAnyPairNothingIsLost) { RunSequence("PAIRS", Setting("RODEIRA_PAIRS", 2), 2); }
TEST_F(TwoLosses, OfAnyTripleNothingIsLost) { RunSequence("TRIPLES", Setting("RODEIRA_TRIPLES", 1), 3); }

}  // namespace
}  // namespace rodeira::system_test

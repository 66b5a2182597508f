// SPDX-License-Identifier: Apache-2.0
// What only shows with time or by chance: the recorder killed at any instant, and a long run of many processes. The
// counts are small here and large in `tests/run --endurance`.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class Endurance : public ::testing::Test {
 protected:
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  const cli::TemporaryFolder folder_;
};

// The number behind `word` in a closing table.
double NumberBehind(const std::string& text, const std::string& word) {
  const auto at = text.find(word);
  return at == std::string::npos ? -1.0 : std::strtod(text.c_str() + at + word.size(), nullptr);
}

// --- the recorder is killed, and not started again ---

class RecorderKilled : public Endurance {
 protected:
  static constexpr std::uintmax_t kFirstSecondBytes =
      100'000;                                     // what is embedded has 20 kB, the first chunk more than these
  static constexpr const char* kSimulated = "20";  // seconds: at the pace below five, longer than a run lasts
  std::vector<std::string> Command(const std::string& run, const std::string& recording) const {
    return {Bin("rodeira"),
            "run",
            kLaunch,
            "--run",
            run,
            "--for",
            kSimulated,
            "--record",
            recording,
            "--pace",
            "4",
            "--set",
            "limits.silence_s=30",
            "--set",
            "limits.step_s=30"};  // another slow node meanwhile is no fault
  }
  // Waits until the recorder's process is there, or until the first second lies in its file.
  static pid_t Find(const std::string& name, const std::string& recording, bool driving) {
    std::error_code none;
    for (int i = 0; i < 10'000; ++i, ::usleep(2000)) {
      if (driving && (!std::filesystem::exists(recording, none) ||
                      std::filesystem::file_size(recording, none) < kFirstSecondBytes))
        continue;
      const auto found = ProcessesWith("--run " + name, "/rodeira-recorder");
      if (found.size() == 1) return found.front();
    }
    return -1;
  }
  // What is left is a prefix of the undisturbed recording, at most a second short of where the run ended; and it is
  // said.
  void ExpectAlmostAll(const std::string& recording, const Ended& ended) {
    const Ended info = RunCommand({Bin("rodeira"), "info", recording});
    EXPECT_EQ(info.status, 1) << info.out;
    EXPECT_THAT(info.out, HasSubstr("not whole"));
    const std::string repaired = recording + ".repaired";
    const Ended repair = RunCommand({Bin("rodeira"), "repair", recording, "--out", repaired});
    ASSERT_LE(repair.status, 1) << repair.out << ended.out;  // 1: a record was torn
    EXPECT_EQ(RunCommand({Bin("rodeira"), "info", repaired}).status, 0);
    const auto samples = SamplesOf(repaired);
    ASSERT_LE(samples.size(), calm_.size());
    EXPECT_EQ(FirstDifference(samples, {calm_.begin(), calm_.begin() + static_cast<std::ptrdiff_t>(samples.size())}),
              "");
    const double reached_s = NumberBehind(ended.out, "simulated ");
    if (reached_s <= 0.0) return;  // killed before the first step
    std::int64_t last = -1;
    for (const Recorded& sample : samples)
      last = std::max(last, sample.topic == idl::topics::kVehicleState ? sample.step : -1);
    const double lost_s = reached_s - static_cast<double>(last) * 1e-3;
    EXPECT_LE(lost_s, 1.0) << repair.out << ended.out;
    fmt::print("{:.3f} s of {:.3f} s lost\n", lost_s, reached_s);
    worst_s_ = std::max(worst_s_, lost_s);
    EXPECT_THAT(ended.out, HasSubstr(fmt::format("holds {:.3f} s of {:.3f} s",
                                                 std::max(0.0, static_cast<double>(last) * 1e-3), reached_s)));
    EXPECT_THAT(ended.out, HasSubstr("rodeira repair " + recording));
  }
  const std::string kLaunch = SourceDir() + "/tests/data/n222_traffic.yaml";
  std::vector<Recorded> calm_;
  double worst_s_ = 0.0;
};

// RODEIRA_RECORDER_KILLS says how often; RODEIRA_RECORDER_KILLS_SEED repeats a sequence of instants.
TEST_F(RecorderKilled, AtAnyInstantCostsAtMostASimulatedSecondAndItIsSaid) {
  const auto kills = Setting("RODEIRA_RECORDER_KILLS", 3);
  const auto seed = Setting("RODEIRA_RECORDER_KILLS_SEED", std::random_device()());
  SCOPED_TRACE(fmt::format("RODEIRA_RECORDER_KILLS_SEED={}", seed));
  fmt::print("RODEIRA_RECORDER_KILLS_SEED={}\n", seed);
  std::mt19937_64 rng(seed);
  const Ended calm =
      RunCommand({Bin("rodeira"), "run", kLaunch, "--in-process", "--for", kSimulated, "--record", File("calm.mcap")});
  ASSERT_EQ(calm.status, 0) << calm.out;
  calm_ = SamplesOf(File("calm.mcap"));
  ASSERT_GT(calm_.size(), 10'000u);
  for (std::uint64_t i = 0; i < kills && !HasFailure(); ++i) {
    const std::string name = fmt::format("killed-recorder-{}-{}", ::getpid(), i);
    const std::string recording = File(name + ".mcap");
    const bool driving = i % 8 != 0;
    const std::chrono::milliseconds wait(rng() % (driving ? 2000 : 500));
    SCOPED_TRACE(
        fmt::format("kill {}, {} ms after {}", i, wait.count(), driving ? "the first second" : "the recorder's start"));
    Started run(Command(name, recording));
    const pid_t victim = Find(name, recording, driving);
    if (victim < 0) FAIL() << "there is no recorder to kill: " << run.Wait(1s).out;
    std::this_thread::sleep_for(wait);
    if (::kill(victim, SIGKILL) != 0) FAIL() << "the recorder was gone before it was killed: " << run.Wait(10s).out;
    const Ended ended = run.Wait(30s);
    EXPECT_EQ(ended.status, 1) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("'recorder' was killed by signal 9"));
    if (std::filesystem::exists(recording)) ExpectAlmostAll(recording, ended);
    std::filesystem::remove(recording);
    std::filesystem::remove(recording + ".repaired");
  }
  fmt::print("at most {:.3f} s lost in {} kills\n", worst_s_, kills);
  EXPECT_GT(worst_s_, 0.0) << "no run had begun";
}

// --- many steps ---

// Resident memory of a process that is no page of a file, kB: what can leak. Pages of programs and libraries come in
// whenever they are first used, as where another run of this machine is heard of.
std::int64_t ResidentOf(pid_t pid) {
  std::int64_t resident_kb = 0;
  std::ifstream in(fmt::format("/proc/{}/status", pid));
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("RssAnon:") || line.starts_with("RssShmem:"))
      resident_kb += std::strtoll(line.c_str() + line.find(':') + 1, nullptr, 10);
  }
  return resident_kb;
}

// Each process' memory, again and again until the run has ended.
std::map<pid_t, std::vector<std::int64_t>> Watch(Started& run, const std::string& name, std::chrono::milliseconds every,
                                                 pid_t& clock) {
  std::map<pid_t, std::vector<std::int64_t>> memory;
  while (run.WaitFor("simulated ", every) < 0ms) {
    for (const pid_t pid : ProcessesWith("--run " + name, "/rodeira-clock")) clock = pid;
    for (const pid_t pid : ProcessesWith("--run " + name)) {
      const std::int64_t resident_kb = ResidentOf(pid);
      if (resident_kb > 0) memory[pid].push_back(resident_kb);
    }
    if (::kill(run.pid(), 0) != 0) break;
  }
  return memory;
}

// No huge pages in this process and in those that it starts: where the kernel makes one of 2 MB of them out of pages in
// use, it fills its gaps, at any time (some 400 kB here), and memory grows though none was asked for.
void WithoutHugePages() {
  if (::prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0) != 0) fmt::print("huge pages stay on: {}\n", std::strerror(errno));
}

// RODEIRA_LONG_STEPS says how many.
TEST_F(Endurance, ALongRunOfEightNodesSkipsNoStepAndItsMemoryIsFlat) {
  WithoutHugePages();
  const auto steps = Setting("RODEIRA_LONG_STEPS", 10'000);
  // Hours on a machine that others use too: a second without the processor is no fault of a node.
  std::string text = "rodeira: launch/1\nlimits: {silence_s: 30, step_s: 30}\nnodes:\n";
  for (int node = 0; node < 8; ++node) text += fmt::format("  n{}: {{kind: empty}}\n", node);
  const std::string launch = folder_.Write("eight.yaml", text).string();
  const std::string seconds = fmt::format("{:.3f}", static_cast<double>(steps) * 1e-3);
  const std::string name = fmt::format("long-{}", ::getpid());
  Started run({Bin("rodeira"), "run", launch, "--no-record", "--for", seconds, "--run", name});
  const auto begin_of_run = std::chrono::steady_clock::now();
  pid_t clock = -1;
  const auto memory = Watch(run, name, std::chrono::milliseconds(steps > 100'000 ? 1000 : 50), clock);
  const auto lasted = std::chrono::steady_clock::now() - begin_of_run;
  const Ended ended = run.Wait(30s);
  ASSERT_EQ(ended.status, 0) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("faults  none"));
  for (int node = 0; node < 8; ++node)
    EXPECT_EQ(NumberBehind(ended.out, fmt::format("\nn{} ", node)), static_cast<double>(steps + 1)) << ended.out;
  Started alone({Bin("rodeira"), "run", launch, "--no-record", "--for", seconds, "--in-process"});
  const Ended in_process = alone.Wait(std::chrono::milliseconds(60'000 + steps));
  EXPECT_EQ(DigestIn(ended.out), DigestIn(in_process.out)) << in_process.out;

  ASSERT_GE(memory.size(), 9u) << "eight nodes and the clock";
  for (const auto& [pid, samples] : memory) {
    ASSERT_GE(samples.size(), 8u) << "too few looks at process " << pid;
    // The first quarter is the start: buffers are touched for the first time.
    const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
    const auto begin = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 4);
    const std::int64_t first = *std::max_element(begin, middle), second = *std::max_element(middle, samples.end());
    fmt::print("process {}: {} kB, then {} kB ({} looks)\n", pid, first, second, samples.size());
    // The clock keeps the wall times of its last hundred seconds for a recorder that starts again: a run that is hardly
    // longer still fills them, with some ten bytes a step.
    const bool fills = pid == clock && lasted < 210s;
    const std::int64_t most = 512 + (fills ? static_cast<std::int64_t>(steps / 100) : 0);
    EXPECT_LE(second, first + most) << pid;
  }
}

}  // namespace
}  // namespace rodeira::system_test

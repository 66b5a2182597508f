// SPDX-License-Identifier: Apache-2.0
// The system time jumps, or the PC sleeps: a run's result is the same, and nothing hangs.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr std::int64_t kYear_s = 365 * 86'400;

class ClockJump : public ::testing::Test {
 protected:
  void SetUp() override {
    const int file = ::open(shift_file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    ASSERT_GE(file, 0);
    ASSERT_EQ(::ftruncate(file, sizeof(std::int64_t)), 0);
    void* mapped = ::mmap(nullptr, sizeof(std::int64_t), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ASSERT_NE(mapped, MAP_FAILED);
    ::close(file);
    shift_s_ = static_cast<volatile std::int64_t*>(mapped);
  }
  void TearDown() override { ::munmap(const_cast<std::int64_t*>(shift_s_), sizeof(std::int64_t)); }

  std::string Name() const { return fmt::format("jump-{}", ::getpid()); }
  // `rodeira run` and its processes read the system time of the shift.
  std::vector<std::string> Command(std::vector<std::string> more) const {
    std::vector<std::string> command{"LD_PRELOAD=" + BinaryDir() + "/bin/rodeira-test-shifted-time.so",
                                     "RODEIRA_TEST_SHIFT=" + shift_file_,
                                     Bin("rodeira"),
                                     "run",
                                     LaunchFile("first_drive.yaml"),
                                     "--run",
                                     Name()};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  // Processor time of the run's processes so far.
  double CpuSeconds() const {
    double ticks = 0.0;
    for (const pid_t pid : ProcessesWith("--run " + Name(), "/rodeira-")) {
      std::ifstream in(fmt::format("/proc/{}/stat", pid));
      std::string text((std::istreambuf_iterator<char>(in)), {});
      std::istringstream rest(text.substr(text.rfind(')') + 1));
      std::string word;
      for (int i = 0; i < 11; ++i) rest >> word;
      double user = 0.0, system = 0.0;
      rest >> user >> system;
      ticks += user + system;
    }
    return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }

  const cli::TemporaryFolder folder_;
  const std::string shift_file_ = (folder_.path() / "shift").string();
  volatile std::int64_t* shift_s_ = nullptr;
};

TEST_F(ClockJump, ChangesNothingButStamps) {
  const Ended calm = RunCommand({Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--for", "4", "--in-process",
                                 "--record", (folder_.path() / "calm.mcap").string()});
  ASSERT_EQ(calm.status, 0) << calm.out;
  for (const std::int64_t years : {-66, 74}) {
    SCOPED_TRACE(years);
    *shift_s_ = 0;
    const std::string recording = (folder_.path() / fmt::format("{}.mcap", years)).string();
    Started run(Command({"--pace", "real", "--for", "4", "--record", recording}));
    ASSERT_TRUE(Runs(Name()));
    *shift_s_ = years * kYear_s;
    ASSERT_TRUE(WaitForStep(Name(), 1500));
    *shift_s_ = -*shift_s_ / 2;
    const Ended ended = run.Wait(40s);
    EXPECT_EQ(ended.status, 0) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("faults  none"));
    EXPECT_EQ(DigestIn(ended.out), DigestIn(calm.out));
    const Ended info = RunCommand({Bin("rodeira"), "info", recording});
    EXPECT_EQ(info.status, 0) << info.out;
    const Ended verified = RunCommand({Bin("rodeira"), "replay", recording, "--verify"});
    EXPECT_EQ(verified.status, 0) << verified.out;
  }
}

// Fast DDS alone would wait for nothing, over and over, in a year before 1970.
TEST_F(ClockJump, ARunBefore1970RestsWhileItIsPausedAndEnds) {
  *shift_s_ = -66 * kYear_s;
  Started run(Command({"--pace", "real", "--for", "1000", "--no-record"}));
  ASSERT_TRUE(Runs(Name()));
  ASSERT_EQ(RunCommand({Bin("rodeira"), "ctl", "pause", "--run", Name()}).status, 0);
  const double before_s = CpuSeconds();
  std::this_thread::sleep_for(2s);
  EXPECT_LT(CpuSeconds() - before_s, 0.6) << "five processes, two seconds";
  ::kill(run.pid(), SIGKILL);
  const auto until = std::chrono::steady_clock::now() + 2s;
  while (!ProcessesWith("--run " + Name()).empty() && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(10ms);
  EXPECT_TRUE(ProcessesWith("--run " + Name()).empty());
}

// RODEIRA_SLEEP_S: how long all processes are stopped (11 s; a run is paused from 10 s on).
TEST(Asleep, ARunInRealTimeWakesPausedAndGoesOn) {
  struct Asleep {
    std::string name;
    std::unique_ptr<Started> run;
    std::vector<pid_t> parts;
  };
  std::vector<Asleep> runs;  // they sleep at the same time
  for (const bool in_process : {true, false}) {
    const std::string name = fmt::format("asleep-{}-{}", ::getpid(), in_process ? "one-process" : "processes");
    std::vector<std::string> command{
        Bin("rodeira"), "run",        LaunchFile("first_drive.yaml"), "--run", name, "--pace", "real", "--for",
        "1000",         "--no-record"};
    if (in_process) command.emplace_back("--in-process");
    runs.push_back({name, std::make_unique<Started>(command), {}});
    ASSERT_TRUE(Runs(name)) << name;
  }
  for (Asleep& asleep : runs) {
    // The front door sleeps first and wakes last: it would take a stopped node for a fault.
    ::kill(asleep.run->pid(), SIGSTOP);
    asleep.parts = ProcessesWith("--run " + asleep.name, "/rodeira-");
    for (const pid_t part : asleep.parts) ::kill(part, SIGSTOP);
  }
  std::this_thread::sleep_for(std::chrono::seconds(Setting("RODEIRA_SLEEP_S", 11)));
  for (const Asleep& asleep : runs) {
    const std::string& name = asleep.name;
    SCOPED_TRACE(name);
    Started& run = *asleep.run;
    for (const pid_t part : asleep.parts) ::kill(part, SIGCONT);
    ::kill(run.pid(), SIGCONT);
    EXPECT_GE(run.WaitFor("the run is paused at step", 10s), 0ms);
    EXPECT_THAT(RunCommand({Bin("rodeira"), "ctl", "state", "--run", name}).out, HasSubstr("paused at step"));
    EXPECT_EQ(RunCommand({Bin("rodeira"), "ctl", "resume", "--run", name}).status, 0);
    EXPECT_THAT(RunCommand({Bin("rodeira"), "ctl", "state", "--run", name}).out, HasSubstr("runs in real time"));
    ::kill(run.pid(), SIGINT);
    const Ended ended = run.Wait(10s);
    EXPECT_EQ(ended.status, 0) << ended.out;
    EXPECT_TRUE(ProcessesWith("--run " + name).empty());
  }
}

}  // namespace
}  // namespace rodeira::system_test

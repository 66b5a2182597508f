// SPDX-License-Identifier: Apache-2.0
// The third table of docs/reference/ends.md: what happens to a PC of a run across two PCs, by each cause under each
// policy, with real processes in network namespaces. Skipped where none can be made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/long_form.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/ends_table.hpp"
#include "tests/system/rig.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

constexpr std::array kPolicies = {"stop", "pause", "restart"};
constexpr auto kPatience = 200s;  // no promise: a run ends late where other tests take the processors

enum class What { kUnplug, kLosePower, kShutDown, kKillFrontDoor };
struct Cause {
  std::string in_table;
  int host = 1;
  What what = What::kUnplug;
  std::chrono::seconds lasts{0};  // until the cable is back
};
// By the test's name. The clock, nodes a and d, and the recorder are on the PC `left`; nodes b and c on `right`.
const std::map<std::string, Cause> kCauses = {
    {"CableOneSecond", {"right: cable pulled for 1 s", 1, What::kUnplug, 1s}},
    {"CableFiveSeconds", {"right: cable pulled for 5 s", 1, What::kUnplug, 5s}},
    {"CableAMinute", {"right: cable pulled for 60 s", 1, What::kUnplug, 60s}},
    {"RightLosesPower", {"right: no power", 1, What::kLosePower}},
    {"LeftLosesPower", {"left: no power", 0, What::kLosePower}},
    {"LeftShutsDown", {"left: shut down, started again", 0, What::kShutDown}},
    {"RightShutsDown", {"right: shut down", 1, What::kShutDown}},
    {"LeftFrontDoorIsKilled", {"left: rodeira run killed", 0, What::kKillFrontDoor}},
    {"RightFrontDoorIsKilled", {"right: rodeira run killed", 1, What::kKillFrontDoor}}};

std::vector<EndsRow> ReadRows() {
  return EndsRowsOf(
      [](const std::string& cause) { return cause.starts_with("left: ") || cause.starts_with("right: "); });
}

class TwoHosts : public testing::Test {
 protected:
  void SetUp() override {
    rig_ = std::make_unique<Rig>(2, Weather{0.0, 0us, false});
    if (!rig_->problem().empty()) GTEST_SKIP() << rig_->problem();
    lab_ = folder_.Write("lab.yaml", Rig::Laboratory(2, "{kind: peers}")).string();
    launch_ =
        folder_
            .Write("launch.yaml",
                   "rodeira: launch/1\nduration_s: 5\nlimits: {start_s: 6}\nnodes: {a: {kind: empty, host: left}, "
                   "b: {kind: empty, host: right}, c: {kind: empty, host: right}, d: {kind: empty}, recorder: "
                   "{kind: recorder, host: left}}\n")
            .string();
    const Ended calm = RunCommand({Bin("rodeira"), "run", launch_, "--in-process", "--record", File("calm.mcap")});
    ASSERT_EQ(calm.status, 0) << calm.out;
    undisturbed_ = DigestIn(calm.out);
  }
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  std::unique_ptr<Started> Start(int host, const std::string& policy, const std::string& pace = "real") {
    std::vector<std::string> words{
        Bin("rodeira"), "run", launch_, "--lab", lab_, "--host", Rig::Name(host), "--set", "recovery=" + policy};
    if (host == 0) words.insert(words.end(), {"--pace", pace, "--record", File(std::to_string(++runs_) + ".mcap")});
    return std::make_unique<Started>(rig_->On(host, words));
  }
  // Of one PC: the processes of all PCs are seen here, those of `right` are called after their host.
  static std::vector<pid_t> ProcessesOf(int host, const Started& door) {
    std::vector<pid_t> found{door.pid()};
    const std::vector<std::string> words = host == 0
                                               ? std::vector<std::string>{"--node a", "--node d", "--node recorder"}
                                               : std::vector<std::string>{"--node b", "--node c", "--follow right"};
    for (const std::string& word : words) {
      for (const pid_t pid : ProcessesWith("--run " + Rig::RunName(), word)) found.push_back(pid);
    }
    if (host == 0) {
      const auto followers = ProcessesWith("--run " + Rig::RunName(), "--follow");
      for (const pid_t pid : ProcessesWith("--run " + Rig::RunName(), "/rodeira-clock")) {
        if (std::ranges::find(followers, pid) == followers.end()) found.push_back(pid);
      }
    }
    return found;
  }
  static bool WaitUntilItDrives() {
    const auto until = std::chrono::steady_clock::now() + 30s;
    while (!Drives() && std::chrono::steady_clock::now() < until) ::usleep(5000);
    return Drives();
  }
  static bool Drives() {
    return ProcessesWith("--run " + Rig::RunName(), "bin/rodeira-empty").size() == 4 && Runs(Rig::RunName(), 20s);
  }
  static bool AllEndWithin(std::chrono::seconds limit) {
    const auto until = std::chrono::steady_clock::now() + limit;
    const auto are_left = [] { return !ProcessesWith("--run " + Rig::RunName(), "bin/rodeira").empty(); };
    while (are_left() && std::chrono::steady_clock::now() < until) ::usleep(5000);
    return !are_left();
  }
  static bool ClockSays(const std::string& text) {
    const auto until = std::chrono::steady_clock::now() + 10s;
    for (; std::chrono::steady_clock::now() < until; ::usleep(5000)) {
      if (RunCommand({Bin("rodeira"), "ctl", "--run", Rig::RunName(), "state"}).out.find(text) != std::string::npos)
        return true;
    }
    return false;
  }
  void Cause(const struct Cause& cause, const std::array<std::unique_ptr<Started>, 2>& pcs) {
    if (cause.what == What::kKillFrontDoor) {
      ::kill(pcs[cause.host]->pid(), SIGKILL);
      return;
    }
    if (cause.what != What::kShutDown) rig_->Unplug(cause.host);
    if (cause.what != What::kUnplug) {
      for (const pid_t pid : ProcessesOf(cause.host, *pcs[cause.host]))
        ::kill(pid, cause.what == What::kShutDown ? SIGTERM : SIGKILL);
    }
    if (cause.lasts <= 0s) return;
    // A run that is over on both PCs sees no cable.
    const auto until = std::chrono::steady_clock::now() + cause.lasts;
    while (std::chrono::steady_clock::now() < until &&
           !ProcessesWith("--run " + Rig::RunName(), "bin/rodeira-").empty())
      std::this_thread::sleep_for(10ms);
    rig_->Plug(cause.host);
  }

  const cli::TemporaryFolder folder_;
  std::unique_ptr<Rig> rig_;
  std::string lab_, launch_, undisturbed_;
  int runs_ = 0;
};
class HostsEnds : public TwoHosts, public testing::WithParamInterface<std::string> {};

TEST_P(HostsEnds, AreThoseOfTheTable) {
  const struct Cause& cause = kCauses.at(GetParam());
  if (cause.lasts > 10s && !IsLongForm()) GTEST_SKIP() << "a long form (RODEIRA_LONG_TESTS)";
  const std::vector<EndsRow> rows = ReadRows();
  ASSERT_EQ(rows.size(), kCauses.size()) << "docs/reference/ends.md";
  const auto row = std::ranges::find(rows, cause.in_table, &EndsRow::cause);
  ASSERT_NE(row, rows.end()) << cause.in_table;
  for (std::size_t p = 0; p < kPolicies.size(); ++p) {
    const std::string policy = kPolicies[p], outcome = row->outcomes[p];
    SCOPED_TRACE(policy);
    std::array<std::unique_ptr<Started>, 2> pcs;
    pcs[1] = Start(1, policy);
    pcs[0] = Start(0, policy);
    ASSERT_TRUE(WaitUntilItDrives());
    Cause(cause, pcs);
    const int other = 1 - cause.host;
    if (outcome == "waits") {
      EXPECT_GE(pcs[0]->WaitFor("the run waits", 10s), 0ms);
      ::kill(pcs[0]->pid(), SIGTERM);
    }
    const Ended ended = pcs[other]->Wait(kPatience), there = pcs[cause.host]->Wait(kPatience);
    const bool in_order = outcome == "ends, or in order" && ended.out.find("\nfaults  none\n") != std::string::npos;
    EXPECT_EQ(ended.status, outcome == "goes on" || in_order ? 0 : 1) << ended.out;
    if (outcome == "ends, or in order" && !in_order) {
      EXPECT_THAT(ended.out, testing::AnyOf(HasLine("signal 15"), HasLine("stopped by a signal … '")));
    }
    EXPECT_NE(ended.out.find(row->message), std::string::npos) << ended.out;
    if (outcome == "goes on") {
      EXPECT_EQ(there.status, 0) << there.out;
      EXPECT_EQ(DigestIn(ended.out), undisturbed_) << ended.out;
    }
    // The processes of a killed `rodeira run` have two seconds (docs/reference/ends.md).
    EXPECT_TRUE(AllEndWithin(cause.what == What::kKillFrontDoor ? 2s : 0s));
    if (cause.what == What::kLosePower) rig_->Plug(cause.host);
  }
  // The PCs can be used again at once.
  std::array<std::unique_ptr<Started>, 2> pcs;
  pcs[1] = Start(1, "stop");
  pcs[0] = Start(0, "stop", "max");
  const Ended again = pcs[0]->Wait(kPatience);
  EXPECT_EQ(again.status, 0) << again.out;
  EXPECT_EQ(DigestIn(again.out), undisturbed_) << again.out;
  EXPECT_EQ(pcs[1]->Wait(kPatience).status, 0);
}

// Where a cable is plugged in, packets arrive up to a second before the interface runs: a node that started meanwhile
// would be heard by no other for good.
TEST_F(TwoHosts, ANodeIsStartedAgainOnceItsInterfaceRuns) {
  std::array<std::unique_ptr<Started>, 2> pcs;
  pcs[1] = Start(1, "restart");
  pcs[0] = Start(0, "restart");
  ASSERT_TRUE(WaitUntilItDrives());
  rig_->SetRunning(1, false);
  ASSERT_GE(pcs[1]->WaitForLine("no running interface … address", 10s), 0ms);
  const auto nodes = ProcessesWith("--run " + Rig::RunName(), "--node b");
  ASSERT_EQ(nodes.size(), 1u);
  ::kill(nodes.front(), SIGKILL);
  ASSERT_TRUE(ClockSays("'b' is starting"));
  rig_->SetRunning(1, true);
  const Ended left = pcs[0]->Wait(kPatience), right = pcs[1]->Wait(kPatience);
  EXPECT_EQ(left.status, 0) << left.out;
  EXPECT_EQ(right.status, 0) << right.out;
  EXPECT_EQ(DigestIn(left.out), undisturbed_) << left.out;
}

INSTANTIATE_TEST_SUITE_P(Causes, HostsEnds,
                         testing::Values("CableOneSecond", "CableFiveSeconds", "CableAMinute", "RightLosesPower",
                                         "LeftLosesPower", "LeftShutsDown", "RightShutsDown", "LeftFrontDoorIsKilled",
                                         "RightFrontDoorIsKilled"),
                         [](const auto& cause) { return cause.param; });

}  // namespace
}  // namespace rodeira::system_test

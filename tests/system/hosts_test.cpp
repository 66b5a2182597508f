// SPDX-License-Identifier: Apache-2.0
// A run across several PCs, each a network namespace of its own on one hub: the digests of one host, however they find
// each other and whatever the network does; and on every PC the same end. Skipped where no namespaces can be made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <set>
#include <thread>

#include "common/core/base/files.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/long_form.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/system/rig.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

// Four empty nodes, all to all; 2000 steps.
constexpr const char* kFour =
    "rodeira: launch/1\nduration_s: 2\nnodes: {a: {kind: empty, host: left}, b: {kind: empty, host: right}, "
    "c: {kind: empty, host: right}, d: {kind: empty}}\n";
// In bad weather a step takes as long as a lost frame that is sent again.
const std::string kInBadWeather = "rodeira: launch/1\nduration_s: " + BriefOrLong<std::string>("0.6", "2") +
                                  "\nnodes: {a: {kind: empty, host: left}, b: {kind: empty, host: right}, c: {kind: "
                                  "empty, host: ";
const std::string kFourInBadWeather = kInBadWeather + "right}, d: {kind: empty}}\n";
const std::string kFourOnThree = kInBadWeather + "third}, d: {kind: empty}}\n";
const Weather kNoMulticast{0.0, 0us, false};
const Weather kBad{0.05, 2000us, false};

class Hosts : public ::testing::Test {
 protected:
  void Make(int hosts, const Weather& weather, const std::string& discovery, const std::string& launch) {
    rig_ = std::make_unique<Rig>(hosts, weather);
    if (!rig_->problem().empty()) GTEST_SKIP() << rig_->problem();
    lab_ = folder_.Write("lab.yaml", Rig::Laboratory(hosts, discovery)).string();
    launch_ = folder_.Write("launch.yaml", launch).string();
  }
  std::vector<std::string> Command(int host, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {Bin("rodeira"), "run", launch_, "--lab", lab_, "--host", Rig::Name(host)});
    return rig_->On(host, more);
  }
  std::unique_ptr<Started> Start(int host, const std::vector<std::string>& more = {}) const {
    return std::make_unique<Started>(Command(host, more));
  }
  std::string DigestOfOneHost() const {
    // In a laboratory no recorder is added that the launch file does not have.
    std::vector<std::string> command{Bin("rodeira"), "run", launch_, "--in-process"};
    if (base::ReadText(launch_).value().find("kind: recorder") == std::string::npos) command.push_back("--no-record");
    const Ended ended = RunCommand(command);
    EXPECT_EQ(ended.status, 0) << ended.out;
    EXPECT_EQ(DigestIn(ended.out).size(), 16u) << ended.out;
    return DigestIn(ended.out);
  }
  // Starts every PC, in the order of their names or against it, and expects the digest of one host on each.
  void ExpectTheSameDigests(int hosts, bool clock_last = false) {
    if (rig_ == nullptr || !rig_->problem().empty()) return;
    const std::string digest = DigestOfOneHost();
    std::vector<std::unique_ptr<Started>> pcs(hosts);
    for (int i = 0; i < hosts; ++i) {
      const int host = clock_last ? hosts - 1 - i : i;
      pcs[host] = Start(host);
    }
    for (int host = 0; host < hosts; ++host) {
      const Ended ended = pcs[host]->Wait(120s);
      EXPECT_EQ(ended.status, 0) << Rig::Name(host) << ":\n" << ended.out;
      EXPECT_EQ(DigestIn(ended.out), digest) << Rig::Name(host) << ":\n" << ended.out;
      EXPECT_NE(ended.out.find("faults  none"), std::string::npos) << Rig::Name(host) << ":\n" << ended.out;
    }
    EXPECT_GT(rig_->hub().passed(), 2000u) << "it went over the network";
  }
  // Until all processes are there and drive.
  static bool WaitUntilItDrives() {
    const auto until = std::chrono::steady_clock::now() + 30s;
    while (ProcessesWith("--run " + Rig::RunName(), "bin/rodeira-empty").size() < 4 &&
           std::chrono::steady_clock::now() < until)
      ::usleep(5000);
    return WaitForStep(Rig::RunName(), 500) &&
           ProcessesWith("--run " + Rig::RunName(), "bin/rodeira-empty").size() == 4;
  }
  void ExpectNoProcessLeft() const { EXPECT_TRUE(ProcessesWith("--run " + Rig::RunName(), "bin/rodeira").empty()); }

  const cli::TemporaryFolder folder_;
  std::unique_ptr<Rig> rig_;
  std::string lab_, launch_;
};

TEST_F(Hosts, TwoByMulticast) {
  Make(2, Weather{}, "{kind: multicast}", kFour);
  ExpectTheSameDigests(2);
}

TEST_F(Hosts, TwoByPeersWithoutMulticast) {
  Make(2, kNoMulticast, "{kind: peers}", kFour);
  ExpectTheSameDigests(2);
}

TEST_F(Hosts, TwoByAServerWithoutMulticast) {
  Make(2, kNoMulticast, "{kind: server}", kFour);
  ExpectTheSameDigests(2, true);
}

TEST_F(Hosts, TwoByPeersInBadWeather) {
  Make(2, kBad, "{kind: peers}", kFourInBadWeather);
  ExpectTheSameDigests(2);
}

TEST_F(Hosts, ThreeByPeersInBadWeather) {
  Make(3, kBad, "{kind: peers}", kFourOnThree);
  ExpectTheSameDigests(3, true);
}

TEST_F(Hosts, ThreeByAServerInBadWeather) {
  Make(3, kBad, "{kind: server, port: 12000}", kFourOnThree);
  ExpectTheSameDigests(3);
  if (rig_->problem().empty()) {
    EXPECT_GT(rig_->hub().lost(), 100u) << "the weather was bad";
  }
}

// The car here, its ground and its recorder there: SUELO's questions cross the network at every step.
TEST_F(Hosts, ADriveInBadWeatherIsRecordedTheSame) {
  const std::string root = SourceDir();
  Make(2, kBad, "{kind: server}",
       "rodeira: launch/1\nname: drive\nworld: " + root +
           "/configs/worlds/plane.yaml\nduration_s: 0.8\nnodes:\n  road: {kind: road}\n"
           "  driver: {kind: input, config: {source: script, script: " +
           root +
           "/configs/scenarios/first_drive.csv}}\n"
           "  ego: {kind: vehicle, host: right, config: {vehicle: " +
           root + "/configs/vehicles/default.yaml}}\n  recorder: {kind: recorder}\n");
  if (!rig_->problem().empty()) return;
  const std::string one = (folder_.path() / "one.mcap").string(), two = (folder_.path() / "two.mcap").string();
  const Ended alone = RunCommand({Bin("rodeira"), "run", launch_, "--in-process", "--record", one});
  ASSERT_EQ(alone.status, 0) << alone.out;
  const auto left = Start(0, {"--record", two});
  const auto right = Start(1);
  const Ended on_left = left->Wait(120s), on_right = right->Wait(10s);
  EXPECT_EQ(on_left.status, 0) << on_left.out;
  EXPECT_EQ(on_right.status, 0) << on_right.out;
  EXPECT_EQ(DigestIn(on_left.out), DigestIn(alone.out));
  EXPECT_EQ(DigestIn(on_right.out), DigestIn(alone.out));
  const auto samples = SamplesOf(one);
  EXPECT_GT(samples.size(), 800u);
  EXPECT_EQ(FirstDifference(samples, SamplesOf(two)), "");
  EXPECT_EQ(on_right.out.find("wrote "), std::string::npos) << "the other PC wrote it";
}

// --- the end, on both PCs ---

// Two screens of one seat, each drawn by a PC of its own: at each step the pictures of one PC alone, byte for byte.
TEST_F(Hosts, ScreensOnTwoPcsShowTheStepsOfOne) {
  const std::string root = SourceDir();
  const auto launch = [&](const std::string& lab, const std::string& left, const std::string& right,
                          const std::string& folder) {
    const auto view = [&](const std::string& screen, const std::string& host) {
      return "  " + screen + ": {kind: view" + host + ", config: {screen: " + screen +
             ", window: never, quality: low, mirrors: [], width_px: 320, height_px: 180, frames: {times_s: [0.5, 1.5], "
             "folder: " +
             (folder_.path() / folder / screen).string() + "}}}\n";
    };
    return "rodeira: launch/1\nname: seat\nlab: " + lab + "\nworld: " + root +
           "/configs/worlds/n222.yaml\nduration_s: 1.6\nnodes:\n  road: {kind: road}\n  driver: {kind: input, config: "
           "{source: autopilot, driver: " +
           root + "/configs/drivers/default.yaml, vehicle: " + root +
           "/configs/vehicles/default.yaml}}\n  ego: {kind: vehicle, config: {vehicle: " + root +
           "/configs/vehicles/default.yaml}}\n" + view("centre", left) + view("side", right);
  };
  const std::string screens =
      "screens:\n  centre: {width_cm: 70.8, height_cm: 39.8, distance_cm: 70, angle_deg: 0, eye_height_cm: 22}\n"
      "  side: {width_cm: 70.8, height_cm: 39.8, distance_cm: 70, angle_deg: -53.66, eye_height_cm: 22}\n";
  Make(2, Weather{}, "{kind: peers}\n" + screens, launch("lab.yaml", ", host: left", ", host: right", "two"));
  if (!rig_->problem().empty()) return;
  (void)folder_.Write(
      "one_lab.yaml",
      "rodeira: lab/1\ndomain: 8\nrun: seat\ntransport: shared_memory\nhosts: {here: {address: 127.0.0.1}}\n" +
          screens);
  const std::string one = folder_.Write("one.yaml", launch("one_lab.yaml", "", "", "one")).string();
  const Ended alone = RunCommand({Bin("rodeira"), "run", one, "--no-record", "--quiet"});
  if (alone.out.find("OpenGL") != std::string::npos) GTEST_SKIP() << "no OpenGL here: " << alone.out;
  ASSERT_EQ(alone.status, 0) << alone.out;
  const auto left = Start(0), right = Start(1);
  const Ended on_left = left->Wait(120s), on_right = right->Wait(30s);
  ASSERT_EQ(on_left.status, 0) << on_left.out;
  ASSERT_EQ(on_right.status, 0) << on_right.out;
  std::set<base::Digest> different;
  for (const char* screen : {"centre", "side"}) {
    for (const char* picture : {"step_000000500.png", "step_000001500.png"}) {
      const auto of_one = base::ReadBytes(folder_.path() / "one" / screen / picture),
                 of_two = base::ReadBytes(folder_.path() / "two" / screen / picture);
      ASSERT_TRUE(of_one.ok() && of_two.ok()) << screen << " " << picture;
      EXPECT_EQ(base::Hash(of_one.value()), base::Hash(of_two.value())) << screen << " " << picture;
      different.insert(base::Hash(of_one.value()));
    }
  }
  EXPECT_EQ(different.size(), 4u) << "another picture at each step and on each screen";
}

TEST_F(Hosts, TheSecondPcWaitsForTheClockAsLongAsItLikes) {
  Make(2, kNoMulticast, "{kind: peers}", kFour);
  if (!rig_->problem().empty()) return;
  const auto right = Start(1);
  std::this_thread::sleep_for(4s);
  EXPECT_TRUE(ProcessesWith("--run " + Rig::RunName(), "bin/rodeira-empty").empty())
      << "nothing begins before the clock is there";
  const Ended left = Start(0)->Wait(60s);
  const Ended ended = right->Wait(10s);
  EXPECT_EQ(left.status, 0) << left.out;
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_EQ(ended.out, left.out) << "one table";
}

TEST_F(Hosts, CtrlCAtTheClockEndsBothInOrder) {
  Make(2, kNoMulticast, "{kind: server}", kFour);
  if (!rig_->problem().empty()) return;
  const auto right = Start(1), left = Start(0, {"--for", "1000", "--pace", "real"});
  ASSERT_TRUE(WaitUntilItDrives());
  ::kill(left->pid(), SIGINT);
  const Ended here = left->Wait(10s), there = right->Wait(10s);
  EXPECT_EQ(here.status, 0) << here.out;
  EXPECT_EQ(there.status, 0) << there.out;
  EXPECT_EQ(here.out, there.out);
  ExpectNoProcessLeft();
}

TEST_F(Hosts, CtrlCAtTheSecondPcIsNamedOnBoth) {
  Make(2, kNoMulticast, "{kind: peers}", kFour);
  if (!rig_->problem().empty()) return;
  const auto right = Start(1), left = Start(0, {"--for", "1000", "--pace", "real"});
  ASSERT_TRUE(WaitUntilItDrives());
  ::kill(right->pid(), SIGINT);
  for (const Ended& ended : {left->Wait(10s), right->Wait(10s)}) {
    EXPECT_EQ(ended.status, 1) << ended.out;
    EXPECT_NE(ended.out.find("it was stopped by a signal (host 'right')"), std::string::npos) << ended.out;
  }
  ExpectNoProcessLeft();
}

TEST_F(Hosts, ANodeKilledOnTheSecondPcIsNamedOnBothWithinASecond) {
  Make(2, kNoMulticast, "{kind: peers}", kFour);
  if (!rig_->problem().empty()) return;
  const auto right = Start(1), left = Start(0, {"--for", "1000", "--pace", "real"});
  ASSERT_TRUE(WaitUntilItDrives());
  const auto victims = ProcessesWith("--run " + Rig::RunName(), "--node c");
  ASSERT_EQ(victims.size(), 1u);
  ::kill(victims[0], SIGKILL);
  const auto took = left->WaitForLine("node 'c' … signal 9 (Killed) … (host 'right')", 5s);
  EXPECT_GE(took, 0ms);
  EXPECT_LE(took, 1000ms);
  EXPECT_GE(right->WaitForLine("node 'c' … signal 9", 1s), 0ms);
  EXPECT_EQ(left->Wait(10s).status, 1);
  EXPECT_EQ(right->Wait(10s).status, 1);
  ExpectNoProcessLeft();
}

TEST_F(Hosts, ANodeKilledOnTheSecondPcIsStartedAgainThere) {
  Make(2, kNoMulticast, "{kind: peers}",
       "rodeira: launch/1\nrecovery: restart\nduration_s: 8\nnodes: {a: {kind: empty, host: left}, b: {kind: empty, "
       "host: right}, "
       "c: {kind: empty, host: right}, d: {kind: empty}, recorder: {kind: recorder, host: left}}\n");
  if (!rig_->problem().empty()) return;
  const std::string one = (folder_.path() / "one.mcap").string(), two = (folder_.path() / "two.mcap").string();
  const Ended alone = RunCommand({Bin("rodeira"), "run", launch_, "--in-process", "--record", one});
  ASSERT_EQ(alone.status, 0) << alone.out;
  const auto left = Start(0, {"--record", two, "--pace", "real"}), right = Start(1);
  ASSERT_TRUE(WaitUntilItDrives());
  const auto victims = ProcessesWith("--run " + Rig::RunName(), "--node c");
  ASSERT_EQ(victims.size(), 1u);
  ::kill(victims[0], SIGKILL);
  const Ended here = left->Wait(60s), there = right->Wait(10s);
  ASSERT_EQ(here.status, 0) << here.out;
  EXPECT_EQ(there.status, 0) << there.out;
  EXPECT_THAT(here.out, HasLine("again   node 'c' … signal 9 … (host 'right')"));
  EXPECT_NE(there.out.find("it is started again"), std::string::npos) << there.out;
  EXPECT_EQ(DigestIn(here.out), DigestIn(alone.out)) << here.out;
  EXPECT_EQ(DigestIn(there.out), DigestIn(alone.out)) << there.out;
  EXPECT_EQ(FirstDifference(SamplesOf(one), SamplesOf(two)), "");
  ExpectNoProcessLeft();
}

TEST_F(Hosts, APulledCableEndsBoth) {
  Make(2, kNoMulticast, "{kind: server}", kFour);
  if (!rig_->problem().empty()) return;
  const auto right = Start(1), left = Start(0, {"--for", "1000", "--pace", "real"});
  ASSERT_TRUE(WaitUntilItDrives());
  rig_->Unplug(1);
  EXPECT_GE(left->WaitFor("has sent nothing for", 2s), 0ms);
  const Ended here = left->Wait(15s), there = right->Wait(15s);
  EXPECT_EQ(here.status, 1) << here.out;
  EXPECT_EQ(there.status, 1) << there.out;
  EXPECT_NE(there.out.find("the clock has sent nothing for 3.0 s: it was killed, stopped or cut off"),
            std::string::npos)
      << there.out;
  ExpectNoProcessLeft();
}

TEST_F(Hosts, WrongInputOfANodeOnTheSecondPcIsStatusTwoOnBoth) {
  Make(2, kNoMulticast, "{kind: peers}", kFour);
  if (!rig_->problem().empty()) return;
  const std::vector<std::string> wrong{"--set", "nodes.b.config.fail_at_stp=3"};
  const auto left = Start(0, wrong), right = Start(1, wrong);
  for (const Ended& ended : {left->Wait(60s), right->Wait(60s)}) {
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_NE(ended.out.find("unknown key 'nodes.b.config.fail_at_stp'; did you mean 'fail_at_step'?"),
              std::string::npos)
        << ended.out;
  }
  ExpectNoProcessLeft();
}

TEST_F(Hosts, ThePcThatComesTwiceIsRefused) {
  Make(2, kNoMulticast, "{kind: peers}", kFour);
  if (!rig_->problem().empty()) return;
  const auto right = Start(1), left = Start(0, {"--for", "1000", "--pace", "real"});
  ASSERT_TRUE(WaitUntilItDrives());
  const Ended again = Start(1)->Wait(20s);
  EXPECT_EQ(again.status, 2) << again.out;
  EXPECT_THAT(again.out, HasLine("run '" + Rig::RunName() + "' in domain 9: host 'right' … already … process " +
                                 std::to_string(right->pid())));
  ::kill(left->pid(), SIGINT);
  EXPECT_EQ(left->Wait(10s).status, 0) << "and the run did not mind";
  EXPECT_EQ(right->Wait(10s).status, 0);
}

TEST_F(Hosts, PcsThatDoNotMeanTheSameRunAreRefused) {
  Make(2, kNoMulticast, "{kind: server}", kFour);
  if (!rig_->problem().empty()) return;
  const auto right = Start(1), left = Start(0, {"--seed", "2"});
  for (const Ended& ended : {left->Wait(60s), right->Wait(20s)}) {
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_NE(ended.out.find("was refused: its roster hash is "), std::string::npos) << ended.out;
  }
  ExpectNoProcessLeft();
}

TEST_F(Hosts, APcStartedTwiceBeforeTheClockIsRefusedToo) {
  Make(2, kNoMulticast, "{kind: peers}", kFour);
  if (!rig_->problem().empty()) return;
  const auto one = Start(1), other = Start(1);
  const pid_t processes[] = {one->pid(), other->pid()};
  // The one that holds the host goes on, whichever it is.
  const Ended left = Start(0)->Wait(60s), first = one->Wait(10s), second = other->Wait(10s);
  EXPECT_EQ(left.status, 0) << left.out;
  EXPECT_EQ(DigestIn(left.out), DigestOfOneHost());
  EXPECT_EQ(first.status + second.status, 2) << first.out << second.out;
  const Ended& refused = first.status == 0 ? second : first;
  const pid_t holder = processes[first.status == 0 ? 0 : 1];
  EXPECT_THAT(refused.out, HasLine("host 'right' … already … process " + std::to_string(holder)));
  ExpectNoProcessLeft();
}

// --- observers (law L5) ---

TEST_F(Hosts, ObserversThatJoinLateDieOrAreSlowChangeNoStep) {
  Make(3, kNoMulticast, "{kind: server}", kFour);
  if (!rig_->problem().empty()) return;
  const std::string digest = DigestOfOneHost();
  const auto observer = [&](int host, std::vector<std::string> words) {
    std::vector<std::string> more{
        Bin("rodeira-test-observer"),
        "--launch",
        launch_,
        "--run",
        Rig::RunName(),
        "--domain",
        "9",
        "--node",
        "observer",
        "--set",
        "transport=udp",
        "--set",
        "discovery={kind: server, address: " + Rig::Address(0) + ", interface: " + Rig::Address(host) + "}"};
    more = rig_->On(host, more);
    words.insert(words.end(), more.begin(), more.end());
    return std::make_unique<Started>(words);
  };
  const auto right = Start(1), left = Start(0, {"--pace", "0.4"});  // five seconds
  const auto slow = observer(2, {"SLOW_MS=20"});
  const auto mortal = observer(1, {});
  ASSERT_TRUE(WaitUntilItDrives());
  EXPECT_GE(mortal->WaitFor("heard much", 5s), 0ms);
  ::kill(mortal->pid(), SIGKILL);
  const auto late = observer(2, {});
  EXPECT_GE(late->WaitFor("heard much", 5s), 0ms);
  EXPECT_GE(slow->WaitFor("heard much", 5s), 0ms);
  for (const Ended& ended : {left->Wait(30s), right->Wait(30s)}) {
    EXPECT_EQ(ended.status, 0) << ended.out;
    EXPECT_EQ(DigestIn(ended.out), digest) << ended.out;
  }
}

}  // namespace
}  // namespace rodeira::system_test

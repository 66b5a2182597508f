// SPDX-License-Identifier: Apache-2.0
// Runs on PCs as they are: beside one another, beside another user's, with little shared memory, without a network.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "launch/rodeira/run/domains.hpp"
#include "launch/rodeira/run/shared_memory.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/long_form.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/command_line.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;

using Words = std::vector<std::string>;

Words Joined(Words first, const Words& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}
Words RunOf(const std::string& name, const Words& more) {
  return Joined({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--run", name, "--no-record"}, more);
}
// What half a second of empty.yaml gives without any DDS.
const std::string& ExpectedDigest() {
  static const std::string kDigest = DigestIn(RunCommand(RunOf("reference", {"--in-process", "--for", "0.5"})).out);
  return kDigest;
}
// A name of a run that prefers this domain.
std::string NameFor(std::uint32_t domain, const std::string& begin) {
  for (int i = 0;; ++i) {
    const std::string name = fmt::format("{}-{}", begin, i);
    if (cli::PreferredDomain(name) == domain) return name;
  }
}

// --- many runs beside one another ---

// In the long form ten runs in a process and four with processes.
TEST(BesideOneAnother, RunsInProcessAndWithProcessesAreControlledByName) {
  const cli::TemporaryFolder folder;
  const std::string runtime = "XDG_RUNTIME_DIR=" + folder.path().string();
  const auto ctl = [&](const std::string& name, const std::string& word) {
    return RunCommand({runtime, Bin("rodeira"), "ctl", word, "--run", name});
  };
  std::vector<std::string> names;
  std::vector<std::unique_ptr<Started>> runs;
  const int in_a_process = BriefOrLong(4, 10), with_processes = BriefOrLong(3, 4);
  for (int i = 0; i < in_a_process + with_processes; ++i) {
    const bool in_process = i < in_a_process;
    // All with processes prefer one domain.
    names.push_back(in_process ? fmt::format("beside-{}", i) : NameFor(131, fmt::format("beside-{}", i)));
    Words command = Joined({runtime}, RunOf(names.back(), {"--for", "1000", "--pace", "0.02"}));
    if (in_process) command.emplace_back("--in-process");
    runs.push_back(std::make_unique<Started>(command));
  }
  std::set<std::string> domains;
  for (std::size_t i = 0; i < names.size(); ++i) {
    bool has_begun = false;
    for (int tries = 0; tries < 600 && !has_begun; ++tries, ::usleep(50'000))
      has_begun = ctl(names[i], "state").status == 0;
    ASSERT_TRUE(has_begun) << names[i];
    if (i < static_cast<std::size_t>(in_a_process)) continue;
    const auto clocks = ProcessesWith("--run " + names[i], "/rodeira-clock");
    ASSERT_EQ(clocks.size(), 1u) << names[i];
    domains.insert(OptionOf(clocks.front(), "--domain"));
  }
  EXPECT_EQ(domains.size(), static_cast<std::size_t>(with_processes))
      << "two runs have one domain: " << ::testing::PrintToString(domains);
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(ctl(names[i], "pause").status, 0) << names[i];
    if (i + 1 < names.size()) {
      EXPECT_THAT(ctl(names[i + 1], "state").out, Not(HasSubstr("paused"))) << "another run than " << names[i];
    }
    EXPECT_THAT(ctl(names[i], "state").out, HasSubstr("paused"));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(ctl(names[i], "stop").status, 0) << names[i];
    const Ended ended = runs[i]->Wait(20s);
    EXPECT_EQ(ended.status, 0) << names[i] << ": " << ended.out;
    if (i + 1 < names.size()) {
      EXPECT_EQ(ctl(names[i + 1], "state").status, 0) << "it ended with " << names[i];
    }
  }
}

// Two processes as one node would answer for one another: the run ends by a sentence that names both.
TEST(BesideOneAnother, ANodeProgramStartedASecondTimeByHandEndsTheRun) {
  Started run(RunOf("by-hand", {"--for", "1000", "--pace", "real"}));
  ASSERT_TRUE(Runs("by-hand"));
  const auto nodes = ProcessesWith("--run by-hand", "--node b");
  ASSERT_EQ(nodes.size(), 1u);
  (void)RunCommand(CommandLineOf(nodes.front()));
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("node 'b' runs twice, as process " + std::to_string(nodes.front())));
  EXPECT_TRUE(ProcessesWith("--run by-hand").empty());
}

// --- two users ---

class TwoUsers : public ::testing::Test {
 protected:
  // An id of no user, and of no test beside this one: limits count all processes of a user.
  const int other_ = 61'000 + static_cast<int>(::getpid() % 4'000);
  static constexpr std::uint32_t kDomain = 219;

  void SetUp() override {
    if (::geteuid() != 0) GTEST_SKIP() << "only root may start processes of another user";
    ASSERT_EQ(::chown(folder_.path().c_str(), other_, other_), 0);
    if (RunCommand(AsOther({"/usr/bin/test", "-x", Bin("rodeira")})).status != 0)
      GTEST_SKIP() << "another user may not execute " << Bin("rodeira");
  }
  void TearDown() override { cli::RemoveLeftOvers({}); }

  Words AsOther(const Words& command) const {
    const std::string id = std::to_string(other_), home = folder_.path().string();
    return Joined({"/usr/bin/env", "-u", "XDG_RUNTIME_DIR", "HOME=" + home, "XDG_DATA_HOME=" + home, "/usr/bin/setpriv",
                   "--reuid", id, "--regid", id, "--clear-groups"},
                  command);
  }
  static Words ForAWhile(const std::string& name, const Words& more = {}) {
    return RunOf(name, Joined({"--for", "1000", "--pace", "0.1"}, more));
  }
  // What dead processes of this user leave: the run and all its processes are killed at once.
  static void LeaveFiles(const std::string& name, std::uint32_t domain) {
    Started run(ForAWhile(name, {"--domain", std::to_string(domain)}));
    ASSERT_TRUE(Runs(name));
    ::kill(run.pid(), SIGSTOP);
    for (const pid_t process : ProcessesWith("--run " + name, "bin/rodeira-")) ::kill(process, SIGKILL);
    ::kill(run.pid(), SIGKILL);
  }
  const cli::TemporaryFolder folder_;
};

TEST_F(TwoUsers, ADomainOfALivingRunOfAnotherUserIsUsedOverUdp) {
  const Words domain{"--domain", std::to_string(kDomain)};
  Started run(ForAWhile("users-one", domain));
  ASSERT_TRUE(Runs("users-one"));
  const Ended other = RunCommand(AsOther(RunOf("users-two", Joined(domain, {"--for", "0.5"}))));
  EXPECT_EQ(other.status, 0) << other.out;
  EXPECT_THAT(other.out, HasLine("rodeira: a run of user 'root' has domain 219; … UDP on 127.0.0.1"));
  EXPECT_EQ(DigestIn(other.out), ExpectedDigest()) << other.out;
  EXPECT_TRUE(Runs("users-one")) << "the first one goes on";
}

// A second process of a node would end the run that is going on.
TEST_F(TwoUsers, ASecondStartOfARunByAnotherUserIsRefused) {
  const Words domain{"--domain", std::to_string(kDomain)};
  Started run(ForAWhile("users-same", domain));
  ASSERT_TRUE(Runs("users-same"));
  const Ended other = RunCommand(AsOther(RunOf("users-same", Joined(domain, {"--for", "0.5"}))));
  EXPECT_EQ(other.status, 2) << other.out;
  EXPECT_THAT(other.out, HasLine("run 'users-same' in domain 219: … already … process " + std::to_string(run.pid()) +
                                 " of user 'root'"));
  EXPECT_TRUE(Runs("users-same")) << "the first one goes on";
  ::kill(run.pid(), SIGINT);
  EXPECT_EQ(run.Wait().status, 0);
}

TEST_F(TwoUsers, ADomainWithFilesOfAnotherUserIsUsedOverUdp) {
  LeaveFiles("users-dead", kDomain);
  const Ended other = RunCommand(AsOther(RunOf("users-after", {"--domain", std::to_string(kDomain), "--for", "0.5"})));
  EXPECT_EQ(other.status, 0) << other.out;
  EXPECT_THAT(other.out, HasLine(" of domain 219 belongs to user 'root'; … UDP on 127.0.0.1"));
  EXPECT_EQ(DigestIn(other.out), ExpectedDigest()) << other.out;
}

// The kernel sets root no limit of threads. A higher limit stops a later part of the start.
TEST_F(TwoUsers, ALimitOfThreadsIsOneSentenceAndLeavesNothing) {
  const std::string recording = (folder_.path() / "a.mcap").string();
  const auto limited = [&](int threads, const Words& more) {
    return RunCommand(Joined({"/usr/bin/prlimit", fmt::format("--nproc={}", threads)},
                             AsOther(Joined({Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--for", "0.2",
                                             "--run", "users-threads", "--record", recording},
                                            more))));
  };
  const auto sentences = [](const std::string& text) {
    std::size_t count = 0;
    for (const char* sentence : {": no further thread can be started (ulimit -u", "rodeira: no thread can be started",
                                 ": cannot create a process: "}) {
      for (auto at = text.find(sentence); at != std::string::npos; at = text.find(sentence, at + 1)) ++count;
    }
    return count;
  };
  std::size_t failed = 0;
  for (const auto& [threads, more] : std::vector<std::pair<int, Words>>{
           {1, {}}, {2, {}}, {8, {}}, {20, {}}, {36, {}}, {44, {}}, {1, {"--in-process"}}, {3, {"--in-process"}}}) {
    SCOPED_TRACE(fmt::format("{} threads {}", threads, more.empty() ? "" : more.front()));
    const Ended ended = limited(threads, more);
    EXPECT_TRUE(ProcessesWith("--run users-threads").empty());
    if (ended.status == 0) {
      EXPECT_THAT(ended.out, HasSubstr("audit   lossless"));
      std::filesystem::remove(recording);
      continue;
    }
    ++failed;
    EXPECT_EQ(ended.status, 1) << ended.out;
    EXPECT_EQ(sentences(ended.out), 1u) << ended.out;
    EXPECT_FALSE(std::filesystem::exists(recording)) << ended.out;
    EXPECT_THAT(ended.out, Not(HasSubstr("wrote "))) << "a recording that is not there";
  }
  EXPECT_GE(failed, 5u) << "the limits are no limits here";
}

TEST_F(TwoUsers, WithoutADomainOfItsOwnARunKeepsAwayFromAnotherUsersFiles) {
  constexpr std::uint32_t kPreferred = 137;
  LeaveFiles("users-left", kPreferred);
  Started run(AsOther(ForAWhile(NameFor(kPreferred, "users-free"))));
  const std::string name = NameFor(kPreferred, "users-free");
  std::vector<pid_t> clocks;
  for (int i = 0; i < 2000 && clocks.size() != 1; ++i, ::usleep(5000))
    clocks = ProcessesWith("--run " + name, "/rodeira-clock");
  ASSERT_EQ(clocks.size(), 1u);
  EXPECT_NE(OptionOf(clocks.front(), "--domain"), std::to_string(kPreferred));
  ::kill(run.pid(), SIGINT);
  (void)run.Wait();
  const Ended whole = RunCommand(AsOther(RunOf(name, {"--for", "0.5"})));
  EXPECT_EQ(whole.status, 0) << whole.out;
  EXPECT_THAT(whole.out, Not(HasSubstr("instead of"))) << "shared memory of its own";
  EXPECT_EQ(DigestIn(whole.out), ExpectedDigest()) << whole.out;
}

// --- little shared memory ---

class SmallSharedMemory : public ::testing::Test {
 protected:
  void SetUp() override {
    if (RunCommand(With("1m", {"/usr/bin/true"})).status != 0) GTEST_SKIP() << "unshare -m is not allowed here";
  }
  static Words With(const std::string& size, const Words& command) {
    return Joined(
        {"/usr/bin/unshare", "-m", "/bin/sh", "-c", "mount -t tmpfs -o size=$0 tmpfs /dev/shm && exec \"$@\"", size},
        command);
  }
};

TEST_F(SmallSharedMemory, RunsAreWhole) {
  const Words large{"--set", "transport={kind: shared_memory, segment_kib: 16384}"};
  struct Case {
    std::string size;
    Words more;
    std::string sentence;
  };
  const std::vector<Case> cases{{"64m", {}, ""},
                                {"8m", {}, ""},
                                {"32m", large, "KiB instead of 16384 KiB\n"},
                                {"8m", large, "KiB instead of 16384 KiB\n"},
                                {"4m", {}, "the run uses UDP on 127.0.0.1 instead of shared memory\n"}};
  for (const auto& [size, more, sentence] : cases) {
    const Ended ended = RunCommand(With(size, RunOf("small-" + size, Joined(more, {"--for", "0.5"}))));
    EXPECT_EQ(ended.status, 0) << size << ": " << ended.out;
    EXPECT_EQ(DigestIn(ended.out), ExpectedDigest()) << size << ": " << ended.out;
    EXPECT_THAT(ended.out, HasSubstr(sentence)) << size;
    EXPECT_EQ(ended.out.find(" instead of ") == std::string::npos, sentence.empty()) << size << ": " << ended.out;
  }
}

TEST_F(SmallSharedMemory, ADrivePassesItsLargeSamplesThroughSmallSegments) {
  const auto drive = [](const Words& more) {
    return Joined({Bin("rodeira"), "run", LaunchFile("demo.yaml"), "--set", "nodes.view.kind=none", "--for", "1.5",
                   "--no-record", "--run", "small-drive"},
                  more);
  };
  const std::string expected = DigestIn(RunCommand(drive({"--in-process"})).out);
  const Ended ended = RunCommand(With("12m", drive({})));
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("KiB instead of 8192 KiB\n"));
  EXPECT_EQ(DigestIn(ended.out), expected) << ended.out;
}

TEST_F(SmallSharedMemory, DoctorSaysWhatRunsUse) {
  const auto doctor = [&](const std::string& size) {
    return RunCommand(With(size, {Bin("rodeira"), "doctor", "--domain", "221"}));
  };
  const Ended some = doctor("32m");
  EXPECT_LE(some.status, 1) << some.out;
  EXPECT_THAT(some.out, HasLine("at least 64 MB … 7 processes … segments of "));
  EXPECT_THAT(some.out, HasSubstr(" round trips between two processes"));
  const Ended least = doctor("2m");
  EXPECT_LE(least.status, 1) << least.out;
  EXPECT_THAT(least.out, HasSubstr("a run of 7 processes uses UDP instead"));
  EXPECT_THAT(least.out, HasSubstr("shared memory has no room for two processes; runs use UDP"));
}

// --- networks that are not there ---

class Network : public ::testing::Test {
 protected:
  void SetUp() override {
    if (RunCommand(In("ip link show lo", {"/usr/bin/true"})).status != 0)
      GTEST_SKIP() << "unshare -n is not allowed here, or the package iproute2 is missing";
  }
  // A network of its own without any interface that is up, prepared by a shell.
  static Words In(const std::string& setup, const Words& command) {
    return Joined({"/usr/bin/unshare", "-n", "/bin/sh", "-c",
                   "PATH=$PATH:/usr/sbin:/sbin; " + setup + " >/dev/null && exec \"$@\"", "sh"},
                  command);
  }
  // Status 2 within 5 s, with one sentence.
  static std::string Refused(const std::string& setup, const Words& more) {
    const auto start = std::chrono::steady_clock::now();
    const Ended ended = RunCommand(In(setup, RunOf("no-network", Joined(more, {"--for", "0.5"}))));
    EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_EQ(std::ranges::count(ended.out, '\n'), 1) << ended.out;
    return ended.out;
  }
};

TEST_F(Network, SharedMemoryNeedsNoInterface) {
  const Ended ended = RunCommand(In("true", RunOf("no-interface", {"--for", "0.5"})));
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_EQ(DigestIn(ended.out), ExpectedDigest()) << ended.out;
}

TEST_F(Network, UdpWorksOverTheLoopBackInterfaceAlone) {
  const Ended ended =
      RunCommand(In("ip link set lo up", RunOf("loop-back", {"--for", "0.5", "--set", "transport=udp"})));
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_EQ(DigestIn(ended.out), ExpectedDigest()) << ended.out;
}

TEST_F(Network, WhatIsMissingIsNamedAtOnce) {
  EXPECT_THAT(Refused("true", {"--set", "transport=udp"}), HasLine("no running interface … IPv4 … UDP"));
  EXPECT_THAT(Refused("true", {"--set", "transport={observers: udp}"}), HasLine("no running interface … IPv4 … UDP"));
  EXPECT_THAT(Refused("ip link add d0 type veth peer name d1 && ip link set d1 up && ip link set d0 up && "
                      "ip -6 address add fd00::1/64 dev d0 nodad",
                      {"--set", "transport=udp"}),
              HasSubstr("(with IPv6 alone: d0, d1)"));
  EXPECT_THAT(Refused("ip link set lo up", {"--set", "transport=udp", "--set", "discovery={interface: 10.99.0.1}"}),
              HasLine("no running interface … address 10.99.0.1"));
  EXPECT_THAT(Refused("ip link add d0 type veth peer name d1 && ip address add 10.99.0.1/24 dev d0 && "
                      "ip link set d1 up && ip link set d0 up",
                      {"--set", "transport=udp"}),
              HasSubstr("the loop-back interface is down, over which the processes of one PC reach each other by UDP"));
}

TEST_F(Network, RestartsNeedTheLoopBackInterface) {
  const cli::TemporaryFolder folder;
  const Ended ended =
      RunCommand(In("true", {Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--for", "0.5", "--record",
                             (folder.path() / "a.mcap").string(), "--set", "recovery=restart"}));
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_THAT(ended.out, HasLine("loop-back interface … 127.0.0.1 … 'recovery: restart'"));
}

TEST_F(Network, AnInterfaceThatGoesAndComesDuringARunIsNamed) {
  Started run(
      In("ip link set lo up && ip link add d0 type veth peer name d1 && ip address add 10.99.0.1/24 dev d0 && "
         "ip link set d1 up && ip link set d0 up",
         RunOf("cable", {"--for", "1000", "--pace", "0.1", "--set", "transport=udp", "--set",
                         "discovery={interface: 10.99.0.1}"})));
  ASSERT_TRUE(Runs("cable"));
  const auto set = [&](const std::string& device, const std::string& state) {
    const Ended ended = RunCommand({"/usr/bin/nsenter", "-t", std::to_string(run.pid()), "-n", "/usr/bin/env",
                                    "PATH=/usr/sbin:/sbin:/usr/bin:/bin", "ip", "link", "set", device, state});
    ASSERT_EQ(ended.status, 0) << ended.out;
  };
  set("d1", "down");  // the other end of the cable
  EXPECT_GE(run.WaitForLine("rodeira: no running interface … address 10.99.0.1", 5s).count(), 0);
  set("d1", "up");
  EXPECT_GE(run.WaitFor("rodeira: the network of the run is there again", 5s).count(), 0);
  EXPECT_TRUE(Runs("cable")) << "the processes of one PC reached each other all the time";
  // Now they do not: the cause is named before the node that is no longer heard.
  set("lo", "down");
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  const auto cause =
      ended.out.find("rodeira: the loop-back interface is down, over which the processes of one PC reach");
  const auto fault = ended.out.find("rodeira: node ");
  EXPECT_NE(cause, std::string::npos) << ended.out;
  EXPECT_NE(fault, std::string::npos) << ended.out;
  EXPECT_LT(cause, fault) << ended.out;
  EXPECT_THAT(ended.out, Not(HasSubstr("Fast DDS"))) << "a raw line of the library";
  EXPECT_THAT(ended.out, Not(HasSubstr("RTPS"))) << "a raw line of the library";
}

}  // namespace
}  // namespace rodeira::system_test

// SPDX-License-Identifier: Apache-2.0
// How the processes of one PC find each other, and what is wrong about it or about a laboratory file: no step depends
// on the first, the second is one sentence and status 2.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "launch/rodeira/run/shared_memory.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

Ended Empty(std::vector<std::string> more) {
  more.insert(more.begin(), {Bin("rodeira"), "run", LaunchFile("empty.yaml")});
  return RunCommand(more);
}

TEST(Discovery, OverUdpEveryKindGivesTheDigestOfSharedMemory) {
  const std::string digest = DigestIn(Empty({}).out);
  ASSERT_EQ(digest.size(), 16u);
  for (const char* kind : {"{kind: multicast}", "{kind: peers, addresses: [127.0.0.1]}",
                           "{kind: server, address: 127.0.0.1, port: 11899}"}) {
    const Ended ended = Empty({"--set", "transport=udp", "--set", std::string("discovery=") + kind});
    EXPECT_EQ(ended.status, 0) << kind << ended.out;
    EXPECT_EQ(DigestIn(ended.out), digest) << kind << ended.out;
  }
}

// Of itself Fast DDS looks for the first four participants of a peer.
TEST(Discovery, ByPeersTenNodesMeet) {
  const cli::TemporaryFolder folder;
  std::string text =
      "rodeira: launch/1\ntransport: udp\ndiscovery: {kind: peers, addresses: [127.0.0.1]}\nduration_s: 0.1\nnodes:\n";
  for (int i = 0; i < 10; ++i) text += "  n" + std::to_string(i) + ": {kind: empty}\n";
  const Ended ended = RunCommand({Bin("rodeira"), "run", folder.Write("ten.yaml", text).string()});
  EXPECT_EQ(ended.status, 0) << ended.out;
}

class TakenPort {
 public:
  TakenPort() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in where{};
    where.sin_family = AF_INET;
    where.sin_addr.s_addr = htonl(INADDR_ANY);
    socklen_t size = sizeof(where);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&where), size), 0);
    EXPECT_EQ(::getsockname(socket_, reinterpret_cast<sockaddr*>(&where), &size), 0);
    number_ = std::to_string(ntohs(where.sin_port));
  }
  ~TakenPort() { ::close(socket_); }
  const std::string& number() const { return number_; }

 private:
  int socket_;
  std::string number_;
};

TEST(Discovery, AServersPortInUseIsOneSentence) {
  const TakenPort port;
  const cli::TemporaryFolder folder;
  const auto before = cli::SharedMemoryFiles();
  const std::string recording = (folder.path() / "never.mcap").string();
  const Ended ended = Empty({"--set", "transport=udp", "--set",
                             "discovery={kind: server, address: 127.0.0.1, port: " + port.number() + "}", "--run",
                             "taken", "--record", recording});
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_EQ(
      ended.out,
      "rodeira: run 'taken': UDP port " + port.number() +
          " of the discovery server is in use by another program; end that one, or name another 'discovery.port'\n");
  EXPECT_TRUE(ProcessesWith("--run taken").empty());
  EXPECT_FALSE(std::filesystem::exists(recording));
  for (const std::string& file : cli::SharedMemoryFiles()) EXPECT_TRUE(before.contains(file)) << file << " was left";
}

class LabRefusal : public ::testing::Test {
 protected:
  std::string Of(const std::vector<std::string>& more) const {
    const std::string run_name = "lab-refusal-" + folder_.path().filename().string();
    std::vector<std::string> words{"--run", run_name};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = Empty(words);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_EQ(std::ranges::count(ended.out, '\n'), 1) << "one sentence was expected:\n" << ended.out;
    EXPECT_TRUE(ProcessesWith("--run " + run_name).empty());
    return ended.out;
  }
  const cli::TemporaryFolder folder_;
  const std::string lab_ =
      folder_
          .Write("rig.yaml",
                 "rodeira: lab/1\ndomain: 5\nhosts: {left: {address: 127.0.0.1}, right: {address: 203.0.113.7}}\n")
          .string();
};

TEST_F(LabRefusal, Hosts) {
  EXPECT_THAT(Of({"--lab", lab_, "--host", "lefft"}), HasLine("rig.yaml: … host 'lefft' … 'left'"));
  EXPECT_THAT(Of({"--lab", lab_, "--host", "right", "--set", "nodes.a.host=right"}),
              HasSubstr("host 'right' has the address 203.0.113.7, which this PC does not have"));
  EXPECT_THAT(Of({"--lab", lab_, "--host", "left", "--set", "nodes.a.host=rigth"}),
              HasLine("node 'a' … host 'rigth' … " + lab_ + " … 'right'"));
  const std::string other =
      folder_
          .Write("other.yaml",
                 "rodeira: lab/1\ndomain: 5\nhosts: {right: {address: 203.0.113.7}, left: {address: 127.0.0.1}}\n")
          .string();
  EXPECT_THAT(Of({"--lab", other, "--host", "left"}), HasSubstr("no node belongs to host 'left'"));
  EXPECT_THAT(Of({"--lab", other, "--host", "left", "--for", "1"}),
              HasSubstr("--for: it belongs to the clock's host, 'right'"));
  EXPECT_THAT(Of({"--lab", other, "--host", "left", "--pace", "real"}),
              HasSubstr("--pace: it belongs to the clock's host, 'right'"));
}

TEST_F(LabRefusal, Options) {
  EXPECT_THAT(Of({"--host", "left"}), HasSubstr("--host: no laboratory file says where the hosts are"));
  EXPECT_THAT(Of({"--lab", lab_}), HasSubstr("--lab: which PC is this? --host NAME was expected"));
  EXPECT_THAT(Of({"--lab", "/no/lab.yaml", "--host", "left"}), HasSubstr("/no/lab.yaml: there is no such file"));
  EXPECT_THAT(
      Of({"--lab", folder_.Write("b.yaml", "rodeira: lab/1\ndomain: 5\nhosts: [left\n").string(), "--host", "left"}),
      HasSubstr("this is no YAML"));
  EXPECT_THAT(Of({"--lab", lab_, "--host", "left", "--in-process"}),
              HasSubstr("--in-process: a run in one process has one host"));
}

// --- left-overs of dead runs ---

class DeadRun : public ::testing::Test {
 protected:
  // A node on its own, killed: its files stay. Their names.
  static std::set<std::string> Die() {
    const auto before = cli::SharedMemoryFiles();
    Started node(
        {Bin("rodeira-empty"), "--launch", LaunchFile("empty.yaml"), "--run", "dead", "--domain", "77", "--node", "a"});
    const auto until = std::chrono::steady_clock::now() + 10s;
    while (cli::SharedMemoryFiles().size() < before.size() + 4 && std::chrono::steady_clock::now() < until)
      ::usleep(5000);
    ::kill(node.pid(), SIGKILL);
    node.Wait(5s);
    std::set<std::string> left;
    std::ranges::set_difference(cli::SharedMemoryFiles(), before, std::inserter(left, left.end()));
    return left;
  }
};

TEST_F(DeadRun, IsClearedAwayByTheNextStartAndALivingRunIsNot) {
  Started living(
      {Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--for", "1000", "--pace", "real", "--run", "living"});
  const auto until = std::chrono::steady_clock::now() + 20s;
  while (ProcessesWith("--run living", "bin/rodeira-").size() < 5 && std::chrono::steady_clock::now() < until)
    ::usleep(5000);
  ASSERT_TRUE(Runs("living"));
  const auto alive = cli::SharedMemoryFiles();
  ASSERT_GT(alive.size(), 5u);
  const auto dead = Die();
  ASSERT_GE(dead.size(), 4u);
  const std::filesystem::path stranger = "/dev/shm/rodeira-test-no-file-of-dds";
  const std::filesystem::path others = "/dev/shm/fastrtps_00000000deadbeef";
  ::close(::open(stranger.c_str(), O_CREAT | O_WRONLY, 0600));
  const bool foreign = ::geteuid() == 0;  // only root can leave a file of another user
  if (foreign) {
    ::close(::open(others.c_str(), O_CREAT | O_WRONLY, 0600));
    ASSERT_EQ(::chown(others.c_str(), 65534, 65534), 0);
  }
  const Ended next = RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--for", "0.1"});
  EXPECT_EQ(next.status, 0) << next.out;
  const auto now = cli::SharedMemoryFiles();
  for (const std::string& file : dead) EXPECT_FALSE(now.contains(file)) << file << " of the dead run is still there";
  for (const std::string& file : alive) EXPECT_TRUE(now.contains(file)) << file << " of the living run is gone";
  EXPECT_TRUE(std::filesystem::exists(stranger));
  if (foreign) {
    EXPECT_TRUE(std::filesystem::exists(others)) << "it is another user's";
  }
  std::filesystem::remove(stranger);
  std::filesystem::remove(others);
  ::kill(living.pid(), SIGINT);
  const Ended ended = living.Wait(10s);
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(ended.out.find("faults  none"), std::string::npos) << ended.out;
}

// In a container with the same /dev/shm no process sees those outside; what they have locked is theirs all the
// same.
TEST_F(DeadRun, ALivingRunOutsideTheContainerIsLeftAlone) {
  const std::vector<std::string> inside{"/usr/bin/unshare", "--pid", "--fork", "--mount-proc"};
  if (::geteuid() != 0 || RunCommand({inside[0], inside[1], inside[2], inside[3], "/bin/true"}).status != 0)
    GTEST_SKIP() << "no namespace of processes can be made here";
  Started living(
      {Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--for", "1000", "--pace", "real", "--run", "outside"});
  const auto until = std::chrono::steady_clock::now() + 20s;
  while (ProcessesWith("--run outside", "bin/rodeira-").size() < 5 && std::chrono::steady_clock::now() < until)
    ::usleep(5000);
  ASSERT_TRUE(Runs("outside"));
  const auto alive = cli::SharedMemoryFiles();
  ASSERT_GT(alive.size(), 5u);
  std::vector<std::string> next = inside;
  next.insert(next.end(), {Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--for", "0.1"});
  const Ended other = RunCommand(next);
  EXPECT_EQ(other.status, 0) << other.out;
  const auto now = cli::SharedMemoryFiles();
  for (const std::string& file : alive) EXPECT_TRUE(now.contains(file)) << file << " of the living run is gone";
  ::kill(living.pid(), SIGINT);
  EXPECT_EQ(living.Wait(10s).status, 0);
}

// Runs that start and end all the time beside each other: none takes a file that another one has just made.
TEST_F(DeadRun, RunsThatStartTogetherLeaveEachOtherAlone) {
  std::vector<std::thread> rounds;
  for (int i = 0; i < 3; ++i) {
    rounds.emplace_back([] {
      for (int j = 0; j < 4; ++j) {
        const Ended ended = RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--for", "0.05"});
        EXPECT_EQ(ended.status, 0) << ended.out;
      }
    });
  }
  for (std::thread& round : rounds) round.join();
}

}  // namespace
}  // namespace rodeira::system_test

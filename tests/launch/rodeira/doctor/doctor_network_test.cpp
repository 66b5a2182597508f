// SPDX-License-Identifier: Apache-2.0
// What the checks of shared memory, ports and DDS say where something is wrong.
#include "launch/rodeira/doctor/doctor_network.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

TEST(SharedMemory, AFolderThatIsMissingOrRefusesIsAFaultOneThatIsFullAWarning) {
  const TemporaryFolder folder;
  EXPECT_EQ(CheckSharedMemory(folder.path(), 1).verdict, Verdict::kOk) << CheckSharedMemory(folder.path(), 1).sentence;
  const Finding missing = CheckSharedMemory(folder.path() / "shm");
  EXPECT_EQ(missing.verdict, Verdict::kFault);
  EXPECT_THAT(missing.sentence,
              HasSubstr("there is no folder " + (folder.path() / "shm").string() + "; a tmpfs was expected there"));
  const Finding refused = CheckSharedMemory("/proc");  // takes no files from any user, root included
  EXPECT_EQ(refused.verdict, Verdict::kFault);
  EXPECT_THAT(refused.sentence, HasSubstr("/proc is not writable"));
  const Finding full = CheckSharedMemory(folder.path(), ~0ull);
  EXPECT_EQ(full.verdict, Verdict::kWarning);
  EXPECT_THAT(full.sentence, HasSubstr("MB were expected: a run of 7 processes uses "));
  EXPECT_THAT(full.sentence, HasSubstr("sudo mount -o remount"));
}

TEST(LoopBack, AnInterfaceThatIsDownIsAWarning) {
  EXPECT_EQ(CheckLoopBackInterface({"192.168.10.1", "127.0.0.1"}).verdict, Verdict::kOk);
  const Finding down = CheckLoopBackInterface({"192.168.10.1"});
  EXPECT_EQ(down.verdict, Verdict::kWarning);
  EXPECT_THAT(down.sentence, Names("127.0.0.1 … ip link set lo"));
}

TEST(SharedMemory, WhatDeadProcessesLeftIsCountedWhatLivingOnesUseIsNot) {
  const TemporaryFolder folder;
  folder.Write("other_programs_file", "x");
  const auto used = folder.Write("fastrtps_living", "x");
  const int open = ::open(used.c_str(), O_RDONLY);
  ASSERT_GE(open, 0);
  EXPECT_EQ(CheckSharedMemory(folder.path(), 1).verdict, Verdict::kOk) << CheckSharedMemory(folder.path(), 1).sentence;
  folder.Write("fastrtps_dead", std::string(3'000'000, 'x'));
  folder.Write("sem.fastrtps_port7411_mutex", "x");
  const Finding finding = CheckSharedMemory(folder.path(), 1);
  EXPECT_EQ(finding.verdict, Verdict::kWarning);
  EXPECT_THAT(finding.sentence, HasSubstr("2 files of dead processes of yours (3 MB) there: rodeira doctor --clean"));
  ::close(open);
  EXPECT_THAT(CheckSharedMemory(folder.path(), 1).sentence, HasSubstr("3 files"));
}

// A UDP port of this PC that no other process gets.
class Taken {
 public:
  explicit Taken(int port) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_ANY);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    bound_ = ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  }
  ~Taken() { ::close(socket_); }
  Taken(const Taken&) = delete;
  Taken& operator=(const Taken&) = delete;
  bool bound() const { return bound_; }

 private:
  int socket_;
  bool bound_ = false;
};

TEST(Ports, OneThatIsTakenIsNamed) {
  // A domain that is quiet just now; runs of other tests come and go.
  for (std::uint32_t domain = 202; domain <= 232; ++domain) {
    const int port = 7400 + 250 * static_cast<int>(domain) + 12;  // discovery of the second participant
    if (CheckPorts(domain).verdict != Verdict::kOk) continue;
    Finding finding;
    {
      const Taken taken(port);
      if (!taken.bound()) continue;
      finding = CheckPorts(domain);
    }
    if (CheckPorts(domain).verdict != Verdict::kOk) continue;
    EXPECT_EQ(finding.verdict, Verdict::kWarning);
    EXPECT_THAT(finding.sentence,
                HasSubstr("UDP " + std::to_string(port) + " (domain " + std::to_string(domain) + ") is taken"));
    return;
  }
  FAIL() << "every domain from 202 to 232 is in use";
}

LoopBackSettings Settings(launch::Transport transport, const std::string& program) {
  LoopBackSettings settings;
  settings.transport = transport;
  settings.domain = 201 + static_cast<std::uint32_t>(::getpid() % 30);
  settings.program = program;
  settings.round_trips = 50;
  return settings;
}

TEST(LoopBack, TwoProcessesAnswerOneAnother) {
  for (const auto transport : {launch::Transport::kSharedMemory, launch::Transport::kUdp}) {
    const auto measured = MeasureLoopBack(Settings(transport, system_test::Bin("rodeira")));
    ASSERT_TRUE(measured.ok()) << measured.error().Text();
    EXPECT_GT(measured.value().median_us, 0.0);
    EXPECT_GE(measured.value().worst_percent_us, measured.value().median_us);
  }
}

TEST(LoopBack, ASecondProcessThatNeverAnswersIsAFault) {
  const TemporaryFolder folder;
  auto settings = Settings(launch::Transport::kSharedMemory,
                           folder.Write("mute", "#!/bin/sh\necho ready\nexec cat\n", 0755).string());
  settings.patience = 300ms;
  const Finding mute = CheckLoopBack(settings);
  EXPECT_EQ(mute.verdict, Verdict::kFault);
  EXPECT_EQ(mute.check, "DDS shared memory");
  EXPECT_EQ(mute.sentence, "question 0 of 50 between two processes over shared_memory in domain " +
                               std::to_string(settings.domain) +
                               " was not answered within 0.3 s; look at 'shared memory' above, or use transport: udp");
  settings.transport = launch::Transport::kUdp;
  EXPECT_THAT(CheckLoopBack(settings).sentence, HasSubstr("does a firewall drop UDP?"));
}

TEST(LoopBack, ASecondProcessThatDoesNotStartIsAFault) {
  const Finding missing = CheckLoopBack(Settings(launch::Transport::kSharedMemory, "/no/such/rodeira"));
  EXPECT_EQ(missing.verdict, Verdict::kFault);
  EXPECT_THAT(missing.sentence, HasSubstr("the second process (/no/such/rodeira) did not become ready"));
  const TemporaryFolder folder;
  const Finding refused = CheckLoopBack(Settings(
      launch::Transport::kUdp, folder.Write("sad", "#!/bin/sh\necho no memory left\nexit 1\n", 0755).string()));
  EXPECT_THAT(refused.sentence, HasSubstr("did not become ready: no memory left"));
}

TEST(LoopBack, CanBeStopped) {
  auto settings = Settings(launch::Transport::kSharedMemory, system_test::Bin("rodeira"));
  settings.cancelled = [] { return true; };
  const auto measured = MeasureLoopBack(settings);
  ASSERT_FALSE(measured.ok());
  EXPECT_EQ(measured.error().Text(), "stopped by a signal");
}

}  // namespace
}  // namespace rodeira::cli

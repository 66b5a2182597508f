// SPDX-License-Identifier: Apache-2.0
// What each check of this PC says where something is wrong.
#include "launch/rodeira/doctor/doctor_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>

#include "launch/rodeira/doctor/built_with.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using ::testing::HasSubstr;

TEST(Packages, TheListIsReadWithoutItsComments) {
  EXPECT_THAT(ParsePackages("# Debian packages\nfonts-x\nlibegl1  # pictures\n\n  \n"),
              ::testing::ElementsAre("fonts-x", "libegl1"));
}

TEST(Packages, OnlyThoseThatARunNeedsAreChecked) {
  const auto own = ParsePackages(PackageList());
  EXPECT_THAT(own, ::testing::Contains("libegl-mesa0"));
  for (const char* other : {"build-essential", "libgtest-dev", "qemu-user", "sumo"}) {
    EXPECT_THAT(own, ::testing::Not(::testing::Contains(other)));
  }
}

TEST(Packages, WhatIsMissingIsNamedWithTheCommandThatInstallsIt) {
  if (!std::filesystem::exists("/usr/bin/dpkg-query")) GTEST_SKIP() << "there is no dpkg on this machine";
  const Finding all = CheckPackages({"dpkg", "libc6"});
  EXPECT_EQ(all.verdict, Verdict::kOk);
  EXPECT_EQ(all.sentence, "all 2 packages that a run needs are installed");
  const Finding one = CheckPackages({"dpkg", "rodeira-no-such-package"});
  EXPECT_EQ(one.verdict, Verdict::kFault);
  EXPECT_EQ(one.sentence, "a package is not installed: sudo apt-get install rodeira-no-such-package");
  const Finding two = CheckPackages({"rodeira-none", "dpkg", "rodeira-no-such-package"});
  EXPECT_EQ(two.sentence, "packages are not installed: sudo apt-get install rodeira-none rodeira-no-such-package");
}

TEST(Packages, WithoutDpkgItIsSaid) {
  const Finding finding = CheckPackages({"dpkg"}, "/no/such/dpkg-query");
  EXPECT_EQ(finding.verdict, Verdict::kWarning);
  EXPECT_THAT(finding.sentence, HasSubstr("there is no /no/such/dpkg-query"));
}

TEST(Programs, ThoseOfThisBuildStart) {
  EXPECT_THAT(NodePrograms(), ::testing::Contains("rodeira-vehicle"));
  const Finding finding = CheckPrograms({"rodeira-clock", "rodeira-recorder"}, BinaryDir() + "/bin");
  EXPECT_EQ(finding.verdict, Verdict::kOk) << finding.sentence;
}

TEST(Programs, WhatIsMissingForbiddenOrBrokenIsNamed) {
  const TemporaryFolder folder;
  const Finding empty = CheckPrograms({"rodeira-clock", "rodeira-road"}, folder.path());
  EXPECT_EQ(empty.verdict, Verdict::kFault);
  EXPECT_THAT(empty.sentence, HasSubstr("in " + folder.path().string() +
                                        ": rodeira-clock is missing, rodeira-road is missing; build again"));
  folder.Write("rodeira-clock", "#!/bin/sh\nexit 0\n", 0644);
  EXPECT_THAT(CheckPrograms({"rodeira-clock"}, folder.path()).sentence, HasSubstr("rodeira-clock may not be executed"));
  folder.Write("rodeira-clock", "#!/bin/sh\n[ \"$1\" = --help ]\n", 0755);
  EXPECT_EQ(CheckPrograms({"rodeira-clock"}, folder.path()).verdict, Verdict::kOk);
  folder.Write("rodeira-view", "#!/bin/sh\necho libosg.so.161: cannot open shared object file >&2\nexit 127\n", 0755);
  const Finding broken = CheckPrograms({"rodeira-clock", "rodeira-view"}, folder.path());
  EXPECT_EQ(broken.verdict, Verdict::kFault);
  EXPECT_THAT(broken.sentence,
              HasSubstr("rodeira-view does not start (libosg.so.161: cannot open shared object file)"));
}

TEST(GeodataCheck, WhatCannotBeLoadedIsAFault) {
  EXPECT_EQ(CheckGeodata({}).verdict, Verdict::kOk);
  const Finding missing = CheckGeodata(base::Failed("terrain.no_geodata", "rodeira-geodata.so is missing"));
  EXPECT_EQ(missing.verdict, Verdict::kFault);
  EXPECT_EQ(missing.sentence, "rodeira-geodata.so is missing");
}

TEST(MathematicsCheck, AnotherChoiceOrAnotherLibraryIsSeen) {
  EXPECT_EQ(CheckMathematics(true, kDebian12Mathematics).verdict, Verdict::kOk);
  const Finding free = CheckMathematics(false, 0x123);
  EXPECT_EQ(free.verdict, Verdict::kFault);
  EXPECT_THAT(free.sentence, HasSubstr("set GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2 before the start"));
  const Finding other = CheckMathematics(true, 0x123);
  EXPECT_EQ(other.verdict, Verdict::kWarning);
  EXPECT_THAT(other.sentence, HasSubstr("digest 0000000000000123"));
}

TEST(Sockets, SmallBuffersAreNamedWithTheCommandThatRaisesThem) {
  const TemporaryFolder proc;
  EXPECT_EQ(CheckSockets(proc.path()).verdict, Verdict::kWarning);
  EXPECT_THAT(CheckSockets(proc.path()).sentence, HasSubstr("rmem_max cannot be read"));
  proc.Write("sys/net/core/rmem_max", "212992\n");
  proc.Write("sys/net/core/wmem_max", "4194304\n");
  const Finding small = CheckSockets(proc.path());
  EXPECT_EQ(small.verdict, Verdict::kWarning);
  EXPECT_THAT(small.sentence, HasSubstr("net.core.rmem_max is 212992"));
  EXPECT_THAT(small.sentence, ::testing::EndsWith("sudo sysctl -w net.core.rmem_max=4194304"));
  proc.Write("sys/net/core/rmem_max", "1048576\n");
  EXPECT_EQ(CheckSockets(proc.path()).verdict, Verdict::kOk);
}

// A socket in the file system that a process listens on, as a display server does.
class Server {
 public:
  explicit Server(const std::filesystem::path& file) : socket_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, file.c_str(), sizeof(address.sun_path) - 1);
    listens_ =
        ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 && ::listen(socket_, 4) == 0;
  }
  ~Server() { ::close(socket_); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  bool listens() const { return listens_; }

 private:
  int socket_;
  bool listens_ = false;
};

TEST(Display, IsTriedAndNotBelieved) {
  const TemporaryFolder folder;
  EXPECT_THAT(CheckDisplay({"", "", "", folder.path()}).sentence, HasSubstr("drawn off-screen"));
  EXPECT_EQ(CheckDisplay({"", "", "", folder.path()}).verdict, Verdict::kOk);
  EXPECT_EQ(CheckDisplay({":7", "", "", folder.path()}).verdict, Verdict::kWarning);
  EXPECT_THAT(CheckDisplay({":7", "", "", folder.path()}).sentence,
              HasSubstr("DISPLAY=':7' and WAYLAND_DISPLAY='' lead to no display server"));
  EXPECT_THAT(CheckDisplay({"office:0", "", "", folder.path()}).sentence, HasSubstr("another PC's"));
  const Server x11(folder.path() / "X7");
  ASSERT_TRUE(x11.listens());
  EXPECT_EQ(CheckDisplay({":7.0", "", "", folder.path()}).verdict, Verdict::kOk);
  EXPECT_THAT(CheckDisplay({":7.0", "", "", folder.path()}).sentence, HasSubstr("a window can be opened"));
  EXPECT_EQ(CheckDisplay({"", "wayland-1", folder.path().string(), folder.path()}).verdict, Verdict::kWarning);
  const Server wayland(folder.path() / "wayland-1");
  ASSERT_TRUE(wayland.listens());
  EXPECT_EQ(CheckDisplay({"", "wayland-1", folder.path().string(), folder.path()}).verdict, Verdict::kOk);
}

TEST(Machine, OneCoreAndLittleMemoryAreWarnings) {
  EXPECT_EQ(CheckCores(2).verdict, Verdict::kOk);
  EXPECT_EQ(CheckCores(1).verdict, Verdict::kWarning);
  EXPECT_THAT(CheckCores(1).sentence, HasSubstr("1 was found; at least 2 were expected"));
  const TemporaryFolder proc;
  EXPECT_THAT(CheckMemory(proc.path()).sentence, HasSubstr("does not say how much is free"));
  proc.Write("meminfo", "MemTotal:  16000000 kB\nMemFree: 100 kB\nMemAvailable:   500000 kB\n");
  EXPECT_EQ(CheckMemory(proc.path()).verdict, Verdict::kWarning);
  EXPECT_THAT(CheckMemory(proc.path()).sentence, HasSubstr("512 MB are free; at least 1000 MB were expected"));
  proc.Write("meminfo", "MemAvailable:   8000000 kB\n");
  EXPECT_EQ(CheckMemory(proc.path()).verdict, Verdict::kOk);
}

TEST(Disk, TheFolderOfRecordingsMustTakeThem) {
  const TemporaryFolder folder;
  EXPECT_EQ(CheckDisk(folder.path() / "not/yet/there", 1).verdict, Verdict::kOk);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "not")) << "a look changes nothing";
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const Finding full = CheckDisk(folder.path(), ~0ull);
  EXPECT_EQ(full.verdict, Verdict::kWarning);
  EXPECT_THAT(full.sentence, HasSubstr("MB were expected: make room"));
  const auto file = folder.Write("file", "text");
  const Finding blocked = CheckDisk(file / "rodeira", 1);
  EXPECT_EQ(blocked.verdict, Verdict::kFault);
  EXPECT_THAT(blocked.sentence, HasSubstr(file.string() + " is no folder"));
  const Finding refused = CheckDisk("/proc/rodeira", 1);
  EXPECT_EQ(refused.verdict, Verdict::kFault);
  EXPECT_THAT(refused.sentence, HasSubstr("/proc is not writable"));
}

}  // namespace
}  // namespace rodeira::cli

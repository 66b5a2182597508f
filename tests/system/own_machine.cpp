// SPDX-License-Identifier: Apache-2.0
// With RODEIRA_OWN_MACHINE in the environment, a test has a /dev/shm and a network of its own (a loop-back interface
// alone), and so have the processes that it starts: it may look at what a run leaves there, and use any domain and
// port, beside other tests.
#include <gtest/gtest.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace rodeira::system_test {
namespace {

// What could not be done; empty: nothing.
std::string Separate() {
  const auto problem = [](const char* what) { return std::string(what) + ": " + std::strerror(errno); };
  if (::unshare(CLONE_NEWNS | CLONE_NEWNET) != 0) return problem("unshare");
  if (::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return problem("mount /");
  if (::mount("tmpfs", "/dev/shm", "tmpfs", MS_NOSUID | MS_NODEV, "mode=1777") != 0) return problem("mount /dev/shm");
  // Names of the network namespaces that a test makes.
  if (::mkdir("/run/netns", 0755) != 0 && errno != EEXIST) return problem("mkdir /run/netns");
  if (::mount("tmpfs", "/run/netns", "tmpfs", MS_NOSUID | MS_NODEV, "mode=755") != 0)
    return problem("mount /run/netns");
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq interface {};
  std::strcpy(interface.ifr_name, "lo");
  interface.ifr_flags = IFF_UP | IFF_RUNNING;
  const bool up = ::ioctl(socket, SIOCSIFFLAGS, &interface) == 0;
  const std::string why = up ? "" : problem("lo");
  ::close(socket);
  return why;
}

class OwnMachine : public testing::Environment {
 public:
  void SetUp() override {
    if (std::getenv("RODEIRA_OWN_MACHINE") == nullptr) return;
    ASSERT_EQ(Separate(), "") << "no machine of its own for this test; configure the build again as this user";
  }
};

[[maybe_unused]] const testing::Environment* const kOwnMachine = testing::AddGlobalTestEnvironment(new OwnMachine);

}  // namespace
}  // namespace rodeira::system_test

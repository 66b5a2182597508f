// SPDX-License-Identifier: Apache-2.0
// A process that was killed and has not ended yet: seen as killed, and what it has locked as no longer locked.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "launch/rodeira/run/processes.hpp"
#include "launch/rodeira/run/shared_memory.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::cli {
namespace {

// A process of this test that has not been waited for is a zombie, like one that waits for its last thread's end.
class Zombie {
 public:
  explicit Zombie(int signal) : pid_(::fork()) {
    if (pid_ == 0) {
      if (signal == 0) ::_exit(3);
      ::signal(signal, SIG_DFL);
      for (;;) ::raise(signal);
    }
    siginfo_t ended{};
    EXPECT_EQ(::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOWAIT), 0);
  }
  Zombie(const Zombie&) = delete;
  Zombie& operator=(const Zombie&) = delete;
  ~Zombie() { ::waitpid(pid_, nullptr, 0); }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

TEST(KilledBy, IsTheSignalOfAZombie) {
  EXPECT_EQ(KilledBy(Zombie(SIGKILL).pid()), SIGKILL);
  EXPECT_EQ(KilledBy(Zombie(SIGTERM).pid()), SIGTERM);
}

TEST(KilledBy, IsNoSignalOfOneThatLivesOrHasLeft) {
  EXPECT_EQ(KilledBy(Zombie(0).pid()), 0);
  EXPECT_EQ(KilledBy(::getpid()), 0);
  EXPECT_EQ(KilledBy(-1), 0);
}

// A lock lives on with a process that has inherited the open file, as with a thread that gets no processor.
TEST(KilledBy, WhatAKilledProcessHasLockedIsLockedByNoneThatLives) {
  const TemporaryFolder folder;
  const auto lock = folder.Write("fastrtps_port7410_el", "");
  int hold[2], ready[2];
  ASSERT_EQ(::pipe(hold), 0);
  ASSERT_EQ(::pipe(ready), 0);
  char byte = 0;
  const pid_t owner = ::fork();
  if (owner == 0) {
    ::close(hold[1]);
    if (::flock(::open(lock.c_str(), O_RDONLY), LOCK_EX) != 0) ::_exit(1);
    if (::fork() == 0) {
      [[maybe_unused]] const ssize_t told = ::write(ready[1], &byte, 1);
      [[maybe_unused]] const ssize_t none = ::read(hold[0], &byte, 1);  // until the test ends
      ::_exit(0);
    }
    for (;;) ::pause();
  }
  ::close(hold[0]);
  ::close(ready[1]);
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_TRUE(IsLockedByLiving(lock));
  ::kill(owner, SIGKILL);
  siginfo_t ended{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(owner), &ended, WEXITED | WNOWAIT), 0);
  const int file = ::open(lock.c_str(), O_RDONLY);
  EXPECT_NE(::flock(file, LOCK_EX | LOCK_NB), 0) << "the file is no longer locked at all";
  ::close(file);
  EXPECT_FALSE(IsLockedByLiving(lock));
  EXPECT_FALSE(IsLockedByLiving(folder.path() / "none_el"));
  ::close(ready[0]);
  ::close(hold[1]);
  ::waitpid(owner, nullptr, 0);
}

}  // namespace
}  // namespace rodeira::cli

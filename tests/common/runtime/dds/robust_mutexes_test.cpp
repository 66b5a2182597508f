// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/robust_mutexes.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace rodeira::dds {
namespace {

// As Fast DDS makes and takes the mutex of a port: process-shared, with a limit of a second.
class SharedMutex {
 public:
  SharedMutex()
      : mutex_(static_cast<pthread_mutex_t*>(
            ::mmap(nullptr, sizeof(pthread_mutex_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {
    pthread_mutexattr_t attributes;
    ::pthread_mutexattr_init(&attributes);
    ::pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED);
    ::pthread_mutex_init(mutex_, &attributes);
    ::pthread_mutexattr_destroy(&attributes);
  }
  ~SharedMutex() {
    ::pthread_mutex_destroy(mutex_);
    ::munmap(mutex_, sizeof(pthread_mutex_t));
  }
  int TimedLock() {
    timespec until{};
    ::clock_gettime(CLOCK_REALTIME, &until);
    until.tv_sec += 1;
    return ::pthread_mutex_timedlock(mutex_, &until);
  }
  int TryLock() { return ::pthread_mutex_trylock(mutex_); }
  int Unlock() { return ::pthread_mutex_unlock(mutex_); }

 private:
  pthread_mutex_t* mutex_;
};

// A process that locks it and is killed.
void DieWith(SharedMutex& mutex) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (mutex.TimedLock() != 0) ::_exit(1);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it had locked it";
}

// Waits until a process sleeps, as in a wait for a mutex; false after ten seconds. The state is the first letter behind
// the name, which is in brackets (proc_pid_stat(5)).
bool AwaitSleepOf(pid_t process) {
  for (int i = 0; i < 10'000; ++i, ::usleep(1000)) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string line;
    std::getline(file, line);
    const auto name_end = line.rfind(") ");
    if (name_end != std::string::npos && line.compare(name_end + 2, 1, "S") == 0) return true;
  }
  return false;
}

TEST(RobustMutexes, AreTheOnesOfTheWholeProgram) { EXPECT_TRUE(SharedMutexesAreRobust()); }

TEST(RobustMutexes, AThreadThatLocksAfterAKilledOwnerGoesOn) {
  SharedMutex mutex;
  for (int death = 0; death < 3; ++death) {
    DieWith(mutex);
    ASSERT_EQ(mutex.TimedLock(), 0) << "not ETIMEDOUT, as with a plain one";
    EXPECT_EQ(mutex.Unlock(), 0);
    DieWith(mutex);
    ASSERT_EQ(mutex.TryLock(), 0);
    EXPECT_EQ(mutex.Unlock(), 0);
  }
  EXPECT_EQ(mutex.TimedLock(), 0) << "it is whole again";
  EXPECT_EQ(mutex.TryLock(), EBUSY);
  EXPECT_EQ(mutex.Unlock(), 0);
}

TEST(RobustMutexes, AWaitingThreadGoesOnWhenTheOwnerDies) {
  SharedMutex mutex;
  int held[2];
  ASSERT_EQ(::pipe(held), 0);
  const pid_t owner = ::fork();
  ASSERT_GE(owner, 0);
  if (owner == 0) {
    const char word = mutex.TimedLock() == 0 ? 'y' : 'n';
    (void)!::write(held[1], &word, 1);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    while (true) ::pause();
  }
  char word = 0;
  ASSERT_EQ(::read(held[0], &word, 1), 1);
  ASSERT_EQ(word, 'y');
  const pid_t waiting = ::fork();
  ASSERT_GE(waiting, 0);
  if (waiting == 0) ::_exit(mutex.TimedLock() == 0 && mutex.Unlock() == 0 ? 0 : 1);
  EXPECT_TRUE(AwaitSleepOf(waiting));
  ::kill(owner, SIGKILL);
  int status = -1;
  EXPECT_EQ(::waitpid(waiting, &status, 0), waiting);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  ::waitpid(owner, nullptr, 0);
  ::close(held[0]);
  ::close(held[1]);
}

// What one process has for itself stays as it was.
TEST(RobustMutexes, PrivateOnesAreLeftAlone) {
  pthread_mutexattr_t attributes;
  ASSERT_EQ(::pthread_mutexattr_init(&attributes), 0);
  ASSERT_EQ(::pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_PRIVATE), 0);
  int robust = -1;
  ASSERT_EQ(::pthread_mutexattr_getrobust(&attributes, &robust), 0);
  EXPECT_EQ(robust, PTHREAD_MUTEX_STALLED);
  ASSERT_EQ(::pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED), 0);
  ASSERT_EQ(::pthread_mutexattr_getrobust(&attributes, &robust), 0);
  EXPECT_EQ(robust, PTHREAD_MUTEX_ROBUST);
  ::pthread_mutexattr_destroy(&attributes);
}

}  // namespace
}  // namespace rodeira::dds

// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/robust_mutexes.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

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
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const char word = mutex.TimedLock() == 0 ? 'y' : 'n';
    (void)!::write(held[1], &word, 1);
    ::usleep(100'000);
    ::kill(::getpid(), SIGKILL);
  }
  char word = 0;
  ASSERT_EQ(::read(held[0], &word, 1), 1);
  ASSERT_EQ(word, 'y');
  EXPECT_EQ(mutex.TimedLock(), 0);
  EXPECT_EQ(mutex.Unlock(), 0);
  ::waitpid(child, nullptr, 0);
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

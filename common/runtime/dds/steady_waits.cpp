// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/steady_waits.hpp"

#include <dlfcn.h>
#include <errno.h>
#include <fastdds/rtps/common/Time_t.h>
#include <pthread.h>
#include <semaphore.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000, kMaxWait_ns = 2 * kSecond_ns;

std::int64_t Nanoseconds(const timespec& time) {
  return static_cast<std::int64_t>(time.tv_sec) * kSecond_ns + static_cast<std::int64_t>(time.tv_nsec);
}

// The moment of the monotonic clock at which as much time has passed as from now to `until` of the system time.
timespec Steady(const timespec& until) {
  timespec system{}, steady{};
  (void)::clock_gettime(CLOCK_REALTIME, &system);
  (void)::clock_gettime(CLOCK_MONOTONIC, &steady);
  const auto seconds = std::clamp<std::int64_t>(until.tv_sec - system.tv_sec, -2, 2);
  const std::int64_t left_ns = std::clamp<std::int64_t>(
      seconds * kSecond_ns + static_cast<std::int64_t>(until.tv_nsec) - static_cast<std::int64_t>(system.tv_nsec), 0,
      kMaxWait_ns);
  const std::int64_t at_ns = Nanoseconds(steady) + left_ns;
  return {at_ns / kSecond_ns, at_ns % kSecond_ns};
}

// Nanoseconds since 1970 by a clock that never jumps: the system time when it was first asked for, and what has passed
// since. Within what the library's 32 bits of seconds hold for years to come.
std::int64_t Stamp_ns() {
  const auto passed = std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  static const std::int64_t began_ns =
      std::clamp<std::int64_t>(std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count(),
                               kSecond_ns, std::int64_t{2'000'000'000} * kSecond_ns) -
      passed;
  return began_ns + passed;
}

}  // namespace

// The dynamic linker takes a function of the program itself before a library's.
extern "C" {

int sem_timedwait(sem_t* semaphore, const timespec* until) {
  const timespec steady = Steady(*until);
  return ::sem_clockwait(semaphore, CLOCK_MONOTONIC, &steady);
}

// A mutex of an owner that has died is taken as it is (robust_mutexes.hpp).
int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* until) noexcept {
  const timespec steady = Steady(*until);
  const int result = ::pthread_mutex_clocklock(mutex, CLOCK_MONOTONIC, &steady);
  return result == EOWNERDEAD ? ::pthread_mutex_consistent(mutex) : result;
}

}  // extern "C"

namespace eprosima::fastrtps {

void Time_t::now(Time_t& now) {
  const std::int64_t ns = Stamp_ns();
  now.seconds = static_cast<std::int32_t>(ns / kSecond_ns);
  now.nanosec = static_cast<std::uint32_t>(ns % kSecond_ns);
}

void rtps::Time_t::now(rtps::Time_t& now) {
  const std::int64_t ns = Stamp_ns();
  now.seconds(static_cast<std::int32_t>(ns / kSecond_ns));
  now.nanosec(static_cast<std::uint32_t>(ns % kSecond_ns));
}

}  // namespace eprosima::fastrtps

namespace rodeira::dds {

bool SharedWaitsAreSteady() {
  return ::dlsym(RTLD_DEFAULT, "sem_timedwait") == reinterpret_cast<void*>(&::sem_timedwait) &&
         ::dlsym(RTLD_DEFAULT, "pthread_mutex_timedlock") == reinterpret_cast<void*>(&::pthread_mutex_timedlock);
}

}  // namespace rodeira::dds

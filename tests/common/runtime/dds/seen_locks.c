// SPDX-License-Identifier: Apache-2.0
// The ThreadSanitizer of GCC 12 does not see pthread_mutex_clocklock, by which Fast DDS takes mutexes with a limit.
// Loaded first, this locks by pthread_mutex_trylock, which it sees.
#define _GNU_SOURCE
#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <time.h>

int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock, const struct timespec* until) {
  for (;;) {
    const int result = pthread_mutex_trylock(mutex);
    if (result != EBUSY) return result;
    struct timespec now;
    clock_gettime(clock, &now);
    if (now.tv_sec > until->tv_sec || (now.tv_sec == until->tv_sec && now.tv_nsec >= until->tv_nsec)) return ETIMEDOUT;
    sched_yield();
  }
}

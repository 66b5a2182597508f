// SPDX-License-Identifier: Apache-2.0
/* LD_PRELOAD: shifts the system time of a process, as a jump of the PC's clock does, by the seconds (int64) in the file
 * that RODEIRA_TEST_SHIFT names; the file may change at any time. The monotonic clock stays. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static volatile int64_t* g_shift;

__attribute__((constructor)) static void open_shift(void) {
  const char* path = getenv("RODEIRA_TEST_SHIFT");
  const int file = path == NULL ? -1 : open(path, O_RDONLY | O_CLOEXEC);
  void* mapped;
  if (file < 0) return;
  mapped = mmap(NULL, sizeof(int64_t), PROT_READ, MAP_SHARED, file, 0);
  if (mapped != MAP_FAILED) g_shift = mapped;
  close(file);
}

static int64_t shift(void) { return g_shift == NULL ? 0 : *g_shift; }

int clock_gettime(clockid_t clock, struct timespec* now) {
  const long result = syscall(SYS_clock_gettime, clock, now);
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) now->tv_sec += shift();
  return (int)result;
}

int gettimeofday(struct timeval* now, void* zone) {
  struct timespec at;
  (void)zone;
  clock_gettime(CLOCK_REALTIME, &at);
  now->tv_sec = at.tv_sec;
  now->tv_usec = at.tv_nsec / 1000;
  return 0;
}

time_t time(time_t* now) {
  struct timespec at;
  clock_gettime(CLOCK_REALTIME, &at);
  if (now != NULL) *now = at.tv_sec;
  return at.tv_sec;
}

/* A wait until a moment of the shifted time: by short waits of the real one, for the shift may change meanwhile.
 * Moments of the monotonic clock are less than ten years. */
int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const struct timespec* until) {
  static int (*next)(pthread_cond_t*, pthread_mutex_t*, const struct timespec*);
  struct timespec now, soon;
  int result;
  if (next == NULL) *(void**)&next = dlsym(RTLD_NEXT, "pthread_cond_timedwait");
  if (until->tv_sec >= 0 && until->tv_sec < 315360000) return next(condition, mutex, until);
  clock_gettime(CLOCK_REALTIME, &now);
  if (until->tv_sec < now.tv_sec || (until->tv_sec == now.tv_sec && until->tv_nsec <= now.tv_nsec)) return ETIMEDOUT;
  syscall(SYS_clock_gettime, CLOCK_REALTIME, &soon);
  soon.tv_nsec += 20000000;
  if (soon.tv_nsec >= 1000000000) soon.tv_sec += 1, soon.tv_nsec -= 1000000000;
  result = next(condition, mutex, &soon);
  return result == ETIMEDOUT ? 0 : result; /* as a wait that wakes without a reason */
}

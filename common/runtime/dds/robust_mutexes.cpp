// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/robust_mutexes.hpp"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>

#include "common/runtime/dds/steady_waits.hpp"

namespace {

template <class Function>
Function* TheNext(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

// The state behind a mutex of a dead owner is taken as it is.
int Recover(pthread_mutex_t* mutex, int result) {
  return result == EOWNERDEAD ? ::pthread_mutex_consistent(mutex) : result;
}

}  // namespace

// The dynamic linker takes a function of the program itself before a library's. These two and
// pthread_mutex_timedlock (steady_waits.cpp) are all that boost::interprocess, of which Fast DDS makes its mutexes,
// calls to make one and to lock it: it never waits without a limit.
extern "C" {

int pthread_mutexattr_setpshared(pthread_mutexattr_t* attributes, int shared) noexcept {
  static auto* const next = TheNext<int(pthread_mutexattr_t*, int)>("pthread_mutexattr_setpshared");
  const int result = next(attributes, shared);
  if (result != 0 || shared != PTHREAD_PROCESS_SHARED) return result;
  return ::pthread_mutexattr_setrobust(attributes, PTHREAD_MUTEX_ROBUST);
}

int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  static auto* const next = TheNext<int(pthread_mutex_t*)>("pthread_mutex_trylock");
  return Recover(mutex, next(mutex));
}

}  // extern "C"

namespace rodeira::dds {

bool SharedMutexesAreRobust() {
  return SharedWaitsAreSteady() &&
         ::dlsym(RTLD_DEFAULT, "pthread_mutexattr_setpshared") ==
             reinterpret_cast<void*>(&::pthread_mutexattr_setpshared) &&
         ::dlsym(RTLD_DEFAULT, "pthread_mutex_trylock") == reinterpret_cast<void*>(&::pthread_mutex_trylock);
}

}  // namespace rodeira::dds

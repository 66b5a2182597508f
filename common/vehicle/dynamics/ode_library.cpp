// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/ode_library.hpp"

#include <ode/ode.h>

#include <mutex>

namespace rodeira::dynamics {

void PrepareOde() {
  static std::once_flag once;
  std::call_once(once, [] { (void)dInitODE2(0); });
  struct Thread {
    Thread() { (void)dAllocateODEDataForThread(dAllocateMaskAll); }
    ~Thread() { dCleanupODEAllDataForThread(); }
  };
  static thread_local const Thread thread;
  (void)thread;
}

}  // namespace rodeira::dynamics

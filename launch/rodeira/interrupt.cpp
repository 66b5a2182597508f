// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/interrupt.hpp"

#include <signal.h>

#include <atomic>

namespace rodeira::cli {
namespace {

std::atomic<bool> g_interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "written by a signal handler");
void SetInterrupted(int) { g_interrupted = true; }

}  // namespace

void CatchInterrupts() {
  ::signal(SIGINT, SetInterrupted);
  ::signal(SIGTERM, SetInterrupted);
  ::signal(SIGHUP, SetInterrupted);
  ::signal(SIGXFSZ, SIG_IGN);
}

bool Interrupted() { return g_interrupted; }

}  // namespace rodeira::cli

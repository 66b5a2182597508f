// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/stop_signals.hpp"

#include <sys/time.h>

#include <atomic>
#include <csignal>

namespace rodeira::dds {
namespace {

std::atomic<int> g_stop_signals = 0;
void OnStopSignal(int) { ++g_stop_signals; }

}  // namespace

void CountStopSignals() {
  std::signal(SIGINT, OnStopSignal);
  std::signal(SIGTERM, OnStopSignal);
  std::signal(SIGHUP, OnStopSignal);
}

void EndProcessWithin(std::chrono::milliseconds limit) {
  std::signal(SIGALRM, SIG_DFL);
  const auto s = std::chrono::duration_cast<std::chrono::seconds>(limit);
  const itimerval end{{0, 0}, {s.count(), std::chrono::microseconds(limit - s).count()}};
  ::setitimer(ITIMER_REAL, &end, nullptr);
}

int StopSignals() { return g_stop_signals; }

}  // namespace rodeira::dds

// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/stop_signals.hpp"

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

int StopSignals() { return g_stop_signals; }

}  // namespace rodeira::dds

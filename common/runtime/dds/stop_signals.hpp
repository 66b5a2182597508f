// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace rodeira::dds {

// From now on SIGINT, SIGTERM and SIGHUP are counted and do not end the process.
void CountStopSignals();
// How many of them have arrived since the process began to count them. Any thread.
int StopSignals();
// After the end of `rodeira run`, or after SIGTERM, no process of a run lives longer.
constexpr std::chrono::milliseconds kEndWithoutSupervisor{1700};
// Ends this process by SIGALRM after `limit`, also if it hangs, unless it ends before. May be
// called in a signal handler.
void EndProcessWithin(std::chrono::milliseconds limit);

}  // namespace rodeira::dds

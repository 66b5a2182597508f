// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

namespace rodeira::dds {

// Of all time-outs and periods: monotonic, so that a change of the system time has no effect.
using WallClock = std::chrono::steady_clock;

// Of one process only: its origin is that of WallClock.
inline std::int64_t NowMs() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(WallClock::now().time_since_epoch()).count();
}

}  // namespace rodeira::dds

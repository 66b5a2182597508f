// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace rodeira::cli {

using WallClock = std::chrono::steady_clock;

// Of the clock that never jumps.
inline double SecondsSince(WallClock::time_point begin) {
  return std::chrono::duration<double>(WallClock::now() - begin).count();
}

}  // namespace rodeira::cli

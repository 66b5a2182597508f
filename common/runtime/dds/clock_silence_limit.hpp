// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "common/runtime/launch/launch.hpp"

namespace rodeira::dds {

// After how long without a message the processes of a run take its clock for lost. With `recovery: restart` a clock
// that is lost is started again, up to three times in a row; a start takes a second or more where other programs take
// the processors.
inline std::chrono::milliseconds ClockSilenceLimit(const launch::Launch& launch) {
  constexpr std::chrono::milliseconds kOfOneClock{3000};
  return launch.recovery() == lockstep::Policy::kRestart ? 3 * kOfOneClock : kOfOneClock;
}

}  // namespace rodeira::dds

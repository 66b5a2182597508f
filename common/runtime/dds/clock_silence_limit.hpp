// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "common/runtime/launch/launch.hpp"

namespace rodeira::dds {

// After how long without a message a node takes the clock of its run for lost. With `recovery: restart` a lost clock is
// started again, also where the new one is lost at once; a start takes a second or more where other programs take the
// processors. On one PC, where no cable can be cut, the node waits for three of them: there `rodeira run` says what it
// gives up.
inline std::chrono::milliseconds ClockSilenceLimit(const launch::Launch& launch) {
  constexpr std::chrono::milliseconds kOfOneClock{3000};
  const bool waits =
      launch.recovery() == lockstep::Policy::kRestart && launch.transport() == launch::Transport::kSharedMemory;
  return waits ? 3 * kOfOneClock : kOfOneClock;
}

}  // namespace rodeira::dds

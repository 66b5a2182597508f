// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "common/runtime/lockstep/in_process.hpp"

namespace rodeira::lockstep {

// How a node is lost in RunShuffled: as by SIGKILL, by SIGTERM, or by SIGSTOP. A stopped node neither computes nor
// receives. It goes on after `lasts_turns`, or the watchdog finds it then (`is_found`) and it is a loss like others.
enum class LossCause { kKilled, kTerminated, kStopped };

// As a PlannedLoss's node: the clock. Every cause kills it, what it has said and has not arrived may be lost with it,
// and after `lasts_turns` another one takes its place, which has heard nothing of what was said before.
inline constexpr NodeIndex kClock = std::numeric_limits<NodeIndex>::max();

// The loss of a node or of the clock (kClock) at a turn that the test chooses.
struct PlannedLoss {
  std::uint64_t turn = 0;  // of the run's loop, which moves one node or message a turn
  NodeIndex node = 0;
  LossCause cause = LossCause::kKilled;
  std::uint64_t lasts_turns = 0;  // of a node that is stopped, or until the next clock is there
  bool is_found = true;           // of a node that is stopped
};

// "node 2 killed at turn 120, …", for messages.
std::string TextOf(const std::vector<PlannedLoss>& losses);

// As RunShuffled, with these losses beside the drawn ones. Once all have finished no node is lost any more.
// settings.deaths has the policies, `remake` and `safe`, as for drawn losses; the clock is started again where the
// policy of all nodes is kRestart.
RunOutcome RunWithLosses(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings,
                         std::uint64_t seed, const std::vector<PlannedLoss>& losses);

}  // namespace rodeira::lockstep

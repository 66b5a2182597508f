// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "common/runtime/dds/clock_run.hpp"
#include "common/runtime/dds/supervisor_pipe.hpp"

namespace rodeira::dds {

// Ends a run: the sentence, and the status to leave with.
struct RunTermination {
  std::string reason;
  int status = 1;
};

// What becomes of a run that has lost a part: named, and then what the node's policy or a person says.
class ClockLosses {
 public:
  // on_restart: another incarnation of the node is expected; the grant that says so is to be said.
  ClockLosses(ClockRun& run, std::function<void(lockstep::NodeIndex)> on_restart)
      : run_(run), on_restart_(std::move(on_restart)) {}

  // Reported by the node itself or by the supervisor of its process. An end where the run cannot go on. Nothing where
  // another incarnation has taken its place.
  std::optional<RunTermination> TakeLost(const LostNode& lost);
  // The node that the watchdog names, if any.
  std::optional<RunTermination> Watch();
  // By the operator's word: a sentence of what is done, or why it cannot be.
  base::Result<std::string> RestartByHand(const std::string& name);

 private:
  std::optional<RunTermination> HandleLoss(lockstep::NodeIndex node, const std::string& reason, int status);
  std::optional<RunTermination> LoseOthersBeside(lockstep::NodeIndex node, const std::string& reason, int status);
  // `reason` is empty for a node that goes with another one.
  void Announce(lockstep::NodeIndex node, const std::string& reason);

  ClockRun& run_;
  std::function<void(lockstep::NodeIndex)> on_restart_;
};

}  // namespace rodeira::dds

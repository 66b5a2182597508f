// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "common/runtime/dds/clock_run.hpp"
#include "common/runtime/dds/supervisor_pipe.hpp"

namespace rodeira::dds {

// Why a run ends, and the exit status of the clock's process.
struct RunTermination {
  std::string reason;
  int status = 1;
};

// Handles the loss of a node: reports it, then applies the node's recovery policy or an operator's command.
class ClockLosses {
 public:
  // on_restart: called when a new incarnation of the node is expected; the caller then publishes the grant.
  ClockLosses(ClockRun& run, std::function<void(lockstep::NodeIndex)> on_restart)
      : run_(run), on_restart_(std::move(on_restart)) {}

  // A loss reported by the node itself or by its supervisor. Returns the termination if the run cannot go on; nothing
  // if a new incarnation replaces the node.
  std::optional<RunTermination> TakeLost(const LostNode& lost);
  // Handles the node that the watchdog reports, if any.
  std::optional<RunTermination> Watch();
  // Restart by an operator's command: returns what is done; an error says why it is not possible.
  base::Result<std::string> RestartByHand(const std::string& name);

 private:
  std::optional<RunTermination> HandleLoss(lockstep::NodeIndex node, const std::string& reason, int status);
  std::optional<RunTermination> LoseOthersBeside(lockstep::NodeIndex node, const std::string& reason, int status);
  // `reason` is empty for a node of the same process as a lost one.
  void Announce(lockstep::NodeIndex node, const std::string& reason);

  ClockRun& run_;
  std::function<void(lockstep::NodeIndex)> on_restart_;
};

}  // namespace rodeira::dds

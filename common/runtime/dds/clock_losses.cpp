// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/clock_losses.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/runtime/dds/statements.hpp"
#include "common/runtime/launch/shared_process.hpp"
#include "common/runtime/lockstep/named_node.hpp"

namespace rodeira::dds {

using lockstep::Phase;

std::optional<RunTermination> ClockLosses::TakeLost(const LostNode& lost) {
  const lockstep::NodeIndex node = run_.roster.Find(lost.node);
  if (node == run_.roster.nodes().size() || lost.incarnation < run_.clock.incarnation(node)) return std::nullopt;
  run_.clock.NoteIncarnation(node, lost.incarnation);
  return HandleLoss(node, fmt::format("node '{}' {} at about step {}", lost.node, lost.text, run_.clock.reached(node)),
                    1);
}

// A node that reported a failure would fail again; one that was not ready in time would not be the next time either.
std::optional<RunTermination> ClockLosses::Watch() {
  const auto fault = run_.watchdog.Check(run_.NowMs(), run_.clock.grant());
  if (!fault) return std::nullopt;
  const lockstep::Report& report = run_.clock.report(fault->node);
  const bool by_its_own_word = report.phase == Phase::kFailed || report.phase == Phase::kRefused;
  if (by_its_own_word || report.phase < Phase::kReady) return RunTermination{fault->reason, fault->status};
  if (fault->silent) Say("silent {} {}", run_.roster.node(fault->node).name, OneLine(fault->reason));
  return HandleLoss(fault->node, fault->reason, fault->status);
}

// Names the fault and does what the node's policy says; an end where that is the end of the run.
std::optional<RunTermination> ClockLosses::HandleLoss(lockstep::NodeIndex node, const std::string& reason, int status) {
  const lockstep::Grant& grant = run_.clock.grant();
  const Phase phase = run_.clock.report(node).phase;
  // Others may still ask a node for its samples that has finished.
  const bool ended_in_order = phase == Phase::kFinished && run_.clock.all_finished();
  if (grant.abort || ended_in_order || run_.missed.Has(node)) return std::nullopt;
  const auto decision = run_.clock.HandleLoss(node);
  switch (decision.policy) {
    case lockstep::Policy::kStop:
      return RunTermination{decision.why.empty() ? reason : reason + "; " + decision.why, status};
    case lockstep::Policy::kPause:
      run_.watchdog.Suspend(node);
      Say("paused {} {}", run_.roster.node(node).name, OneLine(reason));
      run_.controller.NoteFault(reason + "; the run waits for it", run_.Now());
      run_.missed.Lost(node, reason, run_.NowNs());
      return std::nullopt;
    case lockstep::Policy::kRestart:
      Announce(node, reason);
      return LoseOthersBeside(node, reason, status);
  }
  return std::nullopt;
}

// They go with their process, which is started again with all its nodes.
std::optional<RunTermination> ClockLosses::LoseOthersBeside(lockstep::NodeIndex node, const std::string& reason,
                                                            int status) {
  for (const lockstep::NodeIndex other : launch::NodesBeside(run_.launch, node)) {
    if (other == node) continue;
    const auto decision = run_.clock.HandleLoss(other);
    if (decision.policy != lockstep::Policy::kRestart) return RunTermination{reason + "; " + decision.why, status};
    Announce(other, "");
  }
  return std::nullopt;
}

// To `rodeira run`, here by this line and on other PCs by the incarnations in the grant, which end the old process and
// start another.
void ClockLosses::Announce(lockstep::NodeIndex node, const std::string& reason) {
  run_.watchdog.ExpectRestart(node, run_.NowMs());
  run_.missed.Restarted(node);
  Say("restart {} {} {}", run_.roster.node(node).name, run_.clock.incarnation(node), OneLine(reason));
  if (!reason.empty()) run_.controller.NoteFault(reason + "; it is started again", run_.Now());
  on_restart_(node);
}

base::Result<std::string> ClockLosses::RestartByHand(const std::string& name) {
  const auto named = lockstep::NamedNode(run_.roster, name);
  if (!named) return named.error();
  const lockstep::NodeIndex node = named.value();
  if (!run_.clock.recovery().restarts()) {
    return base::Failed(
        "run.cannot_restart",
        fmt::format("node '{}' cannot be restarted: this run keeps no states; start it with a recorder and "
                    "--set recovery=pause or restart",
                    name));
  }
  const std::vector<lockstep::NodeIndex> nodes = launch::NodesBeside(run_.launch, node);
  for (const lockstep::NodeIndex one : nodes) {
    const std::string& of = run_.roster.node(one).name;
    if (run_.launch.node(one).is_live())
      return base::Failed("run.cannot_restart",
                          fmt::format("node '{}' is driven by a person, whose input cannot be computed again", of));
    if (run_.clock.report(one).cannot_save)
      return base::Failed("run.cannot_restart",
                          fmt::format("node '{}' cannot save its state, so it cannot be started again", of));
  }
  const std::string reason =
      fmt::format("node '{}' at about step {}: asked for by the operator", name, run_.clock.reached(node));
  for (const lockstep::NodeIndex one : nodes) run_.clock.ExpectRestart(one);
  Announce(node, reason);
  for (const lockstep::NodeIndex one : nodes) {
    if (one != node) Announce(one, "");
  }
  return fmt::format("'{}' is started again", name);
}

}  // namespace rodeira::dds

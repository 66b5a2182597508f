// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/recovery.hpp"
#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::lockstep {

// The clock only grants (law L2): through = min(slowest progress + window, what the pace allows, the last step).
// Pure logic: reports in, a grant out; the owner brings the wall time.
class Clock {
 public:
  // last_step: the run ends there, inclusive; none: it runs until Stop(). first_step: where the nodes begin (a
  // snapshot's step), 0 for a run from its start. policies: as Recovery.
  Clock(const Roster& roster, std::optional<Step> last_step, Step first_step = 0, std::vector<Policy> policies = {});
  // This clock replaces a lost one. It learns from the nodes' reports what was granted, and grants nothing new before
  // every node has reported and is ready. Until then, and until each recorder has reported what its file holds,
  // grant().resume is kUnknown.
  void Rebuild();
  // An incarnation that `rodeira run` has started. A restarted clock may not have received a report of it yet.
  void NoteIncarnation(NodeIndex node, std::uint32_t incarnation);

  // A report that does not match (unknown node, old incarnation, progress that is no activation or goes back, a phase
  // that goes back) changes nothing and is refused with a sentence.
  base::Status Take(const Report& report);

  // All nodes are ready: the first grant may go out.
  bool all_ready() const;
  bool all_finished() const;
  // All but the sinks have: no sample will come any more.
  bool all_sources_finished() const;
  // The nodes that have not reached `phase`, failed ones included.
  std::vector<std::string> Missing(Phase phase) const;
  // The smallest next activation of all stepped nodes.
  Step slowest_progress() const;
  // The last step that may be granted, without regard to the pace: slowest progress + window.
  Step window_limit() const;

  // The grant that holds now; `pace_limit` is the last step that the pace allows.
  Grant Update(Step pace_limit);
  const Grant& grant() const { return grant_; }
  // The last granted step becomes the last of the run.
  void Stop();
  // The run ends at once; the grant says the reason. The first reason counts.
  void Abort(std::string reason);

  // The next activation of a node; a server has none, it is where the run is (never less than before).
  Step reached(NodeIndex node) const;
  // A node is lost: what its policy says. Where that is kRestart, its next incarnation is expected already.
  Recovery::Decision HandleLoss(NodeIndex node);
  // Another incarnation of the node takes its place; nothing new is granted before it is ready.
  void ExpectRestart(NodeIndex node);
  // The incarnation that takes part now; 0: the first.
  std::uint32_t incarnation(NodeIndex node) const {
    return node < grant_.incarnations.size() ? grant_.incarnations[node] : 0;
  }

  // Where the nodes begin.
  Step first_step() const { return first_step_; }
  const Recovery& recovery() const { return recovery_; }
  // The newest report of a node of the roster.
  const Report& report(NodeIndex node) const { return reports_[node]; }
  const std::vector<Report>& reports() const { return reports_; }
  const Roster& roster() const { return roster_; }
  // Of all nodes' chains, in the roster's order; meaningful once all are finished.
  base::Digest RunDigest() const;

 private:
  void SetIncarnation(NodeIndex node, std::uint32_t incarnation);
  void ForgetReport(NodeIndex node);
  void LearnGranted(const Report& report);
  bool HeardAll() const;
  bool IsMissing(NodeIndex node, Phase phase) const;  // it has not come so far, or has failed
  bool HaveAll(Phase phase) const;
  void SetRecovery();

  const Roster& roster_;
  std::optional<Step> last_step_;
  Step first_step_;
  Recovery recovery_;
  std::vector<Report> reports_;
  std::vector<bool> heard_;
  bool has_predecessor_ = false;
  bool rebuilding_ = false;  // a restarted clock; it has not received all reports yet
  Grant grant_;
};

}  // namespace rodeira::lockstep

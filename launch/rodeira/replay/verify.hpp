// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/runtime/replay/comparison.hpp"
#include "common/runtime/replay/recorded_run.hpp"
#include "launch/rodeira/run/local_nodes.hpp"

namespace rodeira::cli {

// What was computed again and compared; without a difference it is equal to the bit.
struct VerifyResult {
  lockstep::Step first_step = 0;  // where the computation began: a snapshot at or before what was asked
  lockstep::Step last_step = 0;
  std::size_t nodes = 0;      // computed again
  std::uint64_t samples = 0;  // compared
  std::uint64_t snapshots = 0;
  std::vector<std::string> without_state;  // cannot save it: everything is computed from the first step on
  std::vector<std::string> substituted;    // live input: their samples were taken from the recording
  std::vector<std::string> external;       // external nodes: their samples, too
  std::optional<replay::Difference> difference;
};

// What is computed again of a recording.
struct Recomputation {
  lockstep::Step from = 0;                    // begins at the snapshot at or before
  std::optional<lockstep::Step> last_step;    // none: the recording's
  std::optional<lockstep::Step> snapshot_at;  // every node's snapshot before this step is handed back
  std::function<void(lockstep::Step)> on_progress;
  std::function<bool()> stop_requested;  // it fails then
};
// The result of Recompute.
struct Recomputed {
  VerifyResult verdict;
  std::vector<lockstep::Snapshot> snapshots;  // one for each node where they were asked for
  // The nodes, as they stand behind their activation at the step of those snapshots, and what that activation of those
  // without a state published; for a branch, in which only they can go on.
  std::shared_ptr<LocalNodes> nodes;
  std::map<lockstep::NodeIndex, std::vector<lockstep::Sample>> last_published;
};
// Runs the recorded nodes in this process. Wrong input where the recording cannot be read or begun, failed where a node
// fails.
base::Result<Recomputed> Recompute(const replay::RecordedRun& run, const Recomputation& spec);

// Says on standard error what was repaired in the recorded world, as a run does.
void WarnOfWorld(const replay::RecordedRun& run, const LocalNodes& nodes);

// Runs the recording's nodes again in this process, from its launch file and configurations and from the snapshot at or
// before `from`, and compares every sample, every state digest and every snapshot. Live input and external nodes
// are substituted by their recorded samples, sinks by nothing. Failed where a node fails that did not fail then, and
// where it was stopped.
base::Result<VerifyResult> Verify(const replay::RecordedRun& run, lockstep::Step from,
                                  const std::function<void(lockstep::Step)>& on_progress = {},
                                  const std::function<bool()>& stop_requested = {});

}  // namespace rodeira::cli

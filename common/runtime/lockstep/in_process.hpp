// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/runtime/lockstep/clock.hpp"
#include "common/runtime/lockstep/node.hpp"
#include "common/runtime/lockstep/recovery.hpp"
#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/run_controller.hpp"
#include "common/runtime/lockstep/snapshot.hpp"

// The same runner, mailbox and clock as between processes, with nodes in one process: for batches and tests.
namespace rodeira::lockstep {

// A command of the operator, and the client that its answer is for.
struct OperatorCommand {
  Command command;
  std::function<void(const base::Result<std::string>&)> answer;
};

// Settings of a run of one process. Functions are called from threads of the run; those that say so, one at a time.
struct InProcessSettings {
  std::optional<Step> last_step;
  double pace = 0.0;  // as Pacer
  Step snapshot_every = 0;
  std::vector<Snapshot> resume;                      // one for each node in the roster's order, or empty
  Step first_step = 0;                               // where those snapshots were taken
  std::function<void(const Sample&)> on_sample;      // every sample published; one call at a time
  std::function<void(const Snapshot&)> on_snapshot;  // one call at a time
  double loss = 0.0;                                 // RunShuffled: the share of samples and nacks that never arrive
  // RunShuffled: nodes die, with everything that they kept, or are told to end and close what they have open. They are
  // made again where their policy says so (recovery.hpp); otherwise the run ends with the reason as its fault.
  struct Deaths {
    double share = 0.0;            // of the turns at which a node dies …
    double terminated = 0.0;       // … and of these deaths, of those that are told to end
    std::vector<Policy> policies;  // as Recovery
    // A node of another incarnation; for a recorder also what its file holds: all samples through `has_through`, of
    // which the archive is told those in `tail`.
    struct Remade {
      Node* node = nullptr;
      Step has_through = -1;
      std::vector<Sample> tail;
    };
    std::function<Remade(NodeIndex)> remake;
    std::function<Step(NodeIndex)> safe;  // of a recorder: samples valid through it are in its file
  };
  Deaths deaths;
  std::function<bool()> stop_requested;           // asked about every 20 ms
  std::function<void(const Clock&)> on_progress;  // called now and then on the caller's thread
  std::function<std::optional<OperatorCommand>()>
      next_command;                             // RunThreaded: asked about every 20 ms until it has none
  std::function<void(const LogBatch&)> on_log;  // RunThreaded: on the caller's thread
};

// How a run of one process ended.
struct RunOutcome {
  bool ok = false;
  std::string fault;            // why not ok: names node and step
  Step last_step = -1;          // the last step of the run
  base::Digest digest = 0;      // of all samples of all nodes
  std::vector<Report> reports;  // one for each node
  int deaths = 0;               // RunShuffled
  int clocks = 0;               // RunWithLosses: that took the place of a lost one
  std::int64_t slipped_ns = 0;  // real time dropped
  std::int64_t paused_ns = 0;   // wall time
  Lateness lateness;
};

// One thread a node. `nodes` has one entry for each of the roster's, null for services (they take no part).
RunOutcome RunThreaded(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings);

// One thread for all: every choice (which node runs next, which message arrives, twice or late) is drawn from `seed`,
// so that a seed reproduces a failure. Pace and stop_requested are not used. Says so where no node can go on
// (deadlock).
RunOutcome RunShuffled(const Roster& roster, const std::vector<Node*>& nodes, const InProcessSettings& settings,
                       std::uint64_t seed);

}  // namespace rodeira::lockstep

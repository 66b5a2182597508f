// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/step.hpp"

namespace rodeira::lockstep {

// State of a node's life cycle (life.hpp: the events that lead from one state to the next).
enum class Phase : std::uint32_t {
  kStarting = 0,  // the process runs, its model is being created
  kReady = 1,     // published its first samples and has those of all others
  kRunning = 2,
  kFinished = 3,  // ran to the final step, everything is closed
  kFailed = 4,    // message says why
  kRefused = 5,   // as kFailed, because of wrong input: exit status 2
  kLost = 6,      // its process was terminated, crashed or stopped; message says how
  kAborted = 7,   // the clock aborted the run, everything is closed
};

// What a node waits for. kOutput: its output is being written (Node::Flush).
enum class Waiting : std::uint32_t { kNothing = 0, kGrant = 1, kInputs = 2, kServer = 3, kOutput = 4 };

// A step that a restarted process does not know yet.
inline constexpr Step kUnknown = -2;

// What a node tells the clock: its progress each quarter window, before it blocks on the grant, and as a heartbeat.
struct Report {
  NodeIndex node = 0;
  std::uint32_t incarnation = 0;
  Phase phase = Phase::kStarting;
  Step progress = 0;  // the next activation
  Waiting waiting = Waiting::kNothing;
  SourceIndex waiting_source = 0;       // the first missing source, where waiting is kInputs
  std::int64_t since_ms = 0;            // how long it has been computing or waiting, wall time
  base::Digest digest = 0;              // chain of all samples so far, this node's outputs
  std::uint64_t steps = 0;              // activations done
  std::int64_t busy_ns = 0;             // wall time inside Step, all activations together
  std::int64_t worst_ns = 0;            // the longest of them
  std::uint64_t server_calls = 0;       // round trips to a server (SUELO)
  std::int64_t median_interval_ns = 0;  // wall time from activation to activation: half of them at most this,
  std::int64_t p99_interval_ns = 0;     // 99 of 100 at most this; both only once the node has finished
  Step safe = -1;     // of a recorder, which keeps snapshots: samples valid through it are in its file; or kUnknown
  Step granted = -1;  // the newest grant that the node knows …
  bool granted_final = false;  // … and whether that is the last of the run
  bool cannot_save = false;    // its state: it has no snapshots to begin at (Node::can_save)
  std::string message;         // why it failed; what it refused
};

// A step that no run comes to.
inline constexpr Step kNever = std::numeric_limits<Step>::max();

// The clock's word (law L2). Everything in it is a state, so it can be said again at any time.
struct Grant {
  Step through = -1;   // inclusive; -1: nothing granted yet
  bool final = false;  // `through` is the last step of the run: run to it and finish
  bool abort = false;  // stop at once; reason says why
  bool over = false;   // all have finished; a node that lingers may go
  base::Digest roster = 0;
  // Recovery (law L3, recovery.hpp).
  Step safe = kNever;  // samples valid through it need not be kept for a recorder that is started again
  Step resume = 0;     // a lost node goes on from its snapshot there; kUnknown: by a clock that does not know yet
  std::vector<std::uint32_t> incarnations;  // by node: the incarnation that takes part; empty: all 0
  std::string reason;  // why it was aborted; where it is over, the clock's closing words, a line each
};

// One word, as documents have it: "running".
std::string_view PhaseName(Phase phase);

}  // namespace rodeira::lockstep

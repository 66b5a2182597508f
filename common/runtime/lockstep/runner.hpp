// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <vector>

#include "common/runtime/lockstep/bus.hpp"
#include "common/runtime/lockstep/intervals.hpp"
#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/node.hpp"
#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/ring.hpp"

namespace rodeira::lockstep {

// The only loop of the system (law L3): first samples, ready, one activation after the other, finish.
class Runner {
 public:
  // Where and how the node begins.
  struct Settings {
    std::uint32_t incarnation = 0;
    Step snapshot_every = 0;  // 0: none; otherwise one at each multiple, the node's state handed to Bus::Keep
    std::optional<Snapshot>
        resume;          // begin here instead of at step 0; one without a state: the node stands there already
    Step sink_from = 0;  // a sink: the first activation at or after this step, instead of a snapshot
    std::chrono::milliseconds patience{2};       // how long a sample may be missing before it is asked for again …
    std::chrono::milliseconds most_patience{8};  // … doubled after each nack up to this
  };
  // kFailed: refused and lost too; report().phase says which.
  enum class Outcome { kWorking, kBlocked, kFinished, kAborted, kFailed };

  // All references outlive it. `index`: of the node in the roster.
  Runner(const Roster& roster, NodeIndex index, Node& node, Bus& bus, Mailbox& mailbox, Settings settings);

  // Runs to the end on the calling thread.
  Outcome Run();
  // One piece of work: starts, or does one activation, or finishes; waits at most `limit` for what it needs (0: not at
  // all) and says kBlocked where that was not enough.
  Outcome Advance(std::chrono::milliseconds limit);
  // After kBlocked: asks the others to say again what is missing and could be there. Called where the waiting is long.
  void RequestRetransmission();

  // Where the node stands, for heartbeats: any thread may ask at any time.
  Report report() const;
  // The node waits for a server's answer (SUELO): not its own time. Called by the requester, on the runner's thread.
  void BeginServerCall();
  // The answer has come, or the run is over.
  void EndServerCall();

 private:
  enum class Stage { kBegin, kInputs, kStepping, kEnding, kOver };

  Outcome Begin();
  Outcome AwaitInputs(std::chrono::milliseconds limit);
  base::Status FlushStep();
  Outcome Activate(std::chrono::milliseconds limit);
  Outcome End(std::chrono::milliseconds limit);
  Outcome Fail(const base::Error& error);
  Outcome FinishAborted();
  Outcome EndWith(LifeEvent event, std::string reason);
  base::Status PublishAll(std::vector<Sample>& samples);
  Snapshot SnapshotAt(Step step) const;
  base::Status PublishSnapshot(const Snapshot& snapshot);
  base::Status TakeSnapshotIfDue(Step step);
  void ForgetOwnSamples(Step step);
  base::Digest StateDigest();
  void Note(LifeEvent event, Waiting waiting);
  void NoteWaiting(Step step);
  void TellReport();

  const Roster& roster_;
  const NodeIndex index_;
  const RosterNode& spec_;
  Node& node_;
  Bus& bus_;
  Mailbox& mailbox_;
  Settings settings_;
  Outbox outbox_;
  Stage stage_ = Stage::kBegin;
  Step begun_at_ = 0;            // 0, or the step of the snapshot that was resumed
  Step next_ = 0;                // the next activation
  Step settled_ = -1;            // everything before it is done, by the node's own threads too
  Step told_ = -1;               // the progress last told
  Inbox inbox_;                  // of the last activation, used again
  std::vector<Sample> samples_;  // being published
  Ring<Sample> own_;             // own samples that a snapshot or a late peer may still need
  base::StateWriter state_without_names_{base::StateWriter::Names::kWithout};

  mutable std::mutex report_mutex_;
  Report report_;
  Intervals intervals_;
  std::optional<std::chrono::steady_clock::time_point> begun_step_;  // the last activation's
  std::chrono::steady_clock::time_point since_;
};

}  // namespace rodeira::lockstep

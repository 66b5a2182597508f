// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/runtime/lockstep/clock.hpp"
#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/node.hpp"
#include "common/runtime/lockstep/runner.hpp"
#include "common/runtime/lockstep/snapshot.hpp"

namespace rodeira::lockstep {

// A run in one process on the caller's thread, which stands still between two calls. Samples and digests are those of
// RunThreaded.
class SteppedRun {
 public:
  // What a run begins with, and what is told of it.
  struct Settings {
    std::vector<Snapshot> resume;                  // of Beginning(), one for each node; empty: the nodes' Initialise
    std::function<void(const Sample&)> on_sample;  // every sample published, without snapshots
  };

  // `nodes` has one entry for each of the roster's, null for services. Roster and nodes outlive the run.
  SteppedRun(const Roster& roster, const std::vector<Node*>& nodes, Settings settings);
  ~SteppedRun();

  // Publishes the samples valid at step 0. Failed or wrong input with the node's sentence; the run has ended then. Call
  // it first and once.
  base::Status Start();
  // What another run can resume, to begin as this one: valid between Start and the first RunThrough. Services have a
  // snapshot without a state.
  std::vector<Snapshot> Beginning() const;
  // Does all activations up to `step`, inclusive; everything that they publish has arrived then. Errors as Start.
  base::Status RunThrough(Step step);
  // Ends the run at the last step of RunThrough: sinks close what they have open. Errors as Start.
  base::Status Finish();
  // Ends the run as one that has failed. Does nothing where it has ended.
  void Abort(const std::string& reason);

  // Of all samples that were published so far, by all nodes.
  base::Digest digest() const;
  bool has_ended() const { return ended_; }

 private:
  class DirectBus;

  base::Status Advance();
  bool AdvanceAll();
  bool SendGrant();
  base::Status Route(const Sample& sample);
  void Hear(const Report& report);

  const Roster& roster_;
  const std::vector<Node*> nodes_;
  const Settings settings_;
  Clock clock_;
  Step limit_ = -1;  // what the caller has asked for
  std::vector<std::vector<NodeIndex>> consumers_;
  std::vector<std::unique_ptr<Mailbox>> mailboxes_;
  std::unique_ptr<DirectBus> bus_;
  std::vector<std::unique_ptr<Runner>> runners_;
  std::vector<bool> over_;
  std::vector<std::vector<Sample>> first_;  // by node, until the first RunThrough
  Grant sent_;
  base::Status fault_;
  bool ended_ = false;
};

}  // namespace rodeira::lockstep

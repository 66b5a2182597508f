// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The interface of a node.

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/runtime/lockstep/inbox.hpp"
#include "common/runtime/lockstep/outbox.hpp"
#include "common/runtime/lockstep/step.hpp"

namespace rodeira::lockstep {

/// A node: a value that is advanced step by step (law L3). It knows no network, no thread and no wall clock. All
/// functions are called by one thread at a time. An error of a function that returns a Status ends the node.
class Node {
 public:
  virtual ~Node() = default;

  /// Publishes the samples valid at step 0, from the configuration and the ground alone. Called once, before any Step,
  /// in a node that is not restored.
  /// @param outbox receives one sample of each output
  /// @return an error if the node cannot begin
  virtual base::Status Initialise(Outbox& outbox) = 0;
  /// One activation. The inbox holds all that the node may know; the same inputs give the same outputs.
  /// @param step time of this activation
  /// @param inbox the inputs
  /// @param outbox receives one sample of each output
  /// @return an error if the node cannot continue
  virtual base::Status Step(const StepInfo& step, const Inbox& inbox, Outbox& outbox) = 0;

  /// Waits until the node's own threads have finished the work of this activation (files are written), so that a
  /// restarted node need not repeat it. Called after each activation, before its progress is reported. The deadline of
  /// a step does not apply.
  /// @return an error if the work failed
  virtual base::Status Flush() { return {}; }

  /// Says whether the node's steps are short, use no ground server, and may run on any thread, one at a time. They then
  /// run on the thread that receives the last input, without a switch between threads.
  /// @return true if it is so
  virtual bool runs_inline() const { return false; }

  /// Writes the whole state before an activation: everything that later steps depend on.
  /// @param out receives the fields, always in the same order
  virtual void Save(base::StateWriter& out) const = 0;
  /// Reads the state of Save into a new node of the same configuration. The node then computes the same bits as the
  /// node that was saved. Errors stay in the reader (base::StateReader::Finish), which the caller tests.
  /// @param in the fields of Save, in the same order
  virtual void Restore(base::StateReader& in) = 0;

  /// Says whether the state can be read out. If not (a model of another maker), Save writes the known part for the
  /// digests and Restore is never called: snapshots have no state, and the node is computed again from its first step.
  /// @return true if Save writes the whole state
  virtual bool can_save() const { return true; }

  /// Begins a branch of a run from the samples that the node of the original run has published. Called instead of
  /// Initialise if the state of that node does not fit this one.
  /// @param published the newest sample of each output of the original node
  /// @return wrong input unless the node supports this
  virtual base::Status InitialiseFrom([[maybe_unused]] const std::vector<Sample>& published) {
    return base::WrongInput("run.cannot_restore",
                            "its state does not fit what was changed, and it cannot begin from what was published");
  }

  /// Ends a sink: delivers the samples after its last activation. Close files here.
  /// @param rest samples of event ports after the last activation, through `last_step`
  /// @param last_step last step of the run; of an aborted run the last step of which all samples arrived
  /// @param complete false: the run was aborted
  /// @return an error if the work cannot be finished
  virtual base::Status Finish([[maybe_unused]] const Inbox& rest, [[maybe_unused]] lockstep::Step last_step,
                              [[maybe_unused]] bool complete) {
    return {};
  }
};

}  // namespace rodeira::lockstep

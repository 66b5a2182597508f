// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/runtime/lockstep/inbox.hpp"
#include "common/runtime/lockstep/outbox.hpp"
#include "common/runtime/lockstep/step.hpp"

namespace rodeira::lockstep {

// A node is a value that is stepped (law L3). It knows no network, no thread and no clock on the wall.
class Node {
 public:
  virtual ~Node() = default;

  // Publishes the samples valid at 0, from configuration and SUELO alone.
  virtual base::Status Initialise(Outbox& outbox) = 0;
  // One activation: what `inbox` shows is all that the node may know; returning means "step done".
  virtual base::Status Step(const StepInfo& step, const Inbox& inbox, Outbox& outbox) = 0;

  // After each activation, before its progress is told: waits until what it gave to the node's own threads is done
  // (pictures in their files), so that a restarted node need not do that again. It takes as long as the machine takes;
  // the step's deadline does not count.
  virtual base::Status Settle() { return {}; }

  // Its steps are short, ask no server (SUELO) and may run on any thread, one at a time: then they are done where the
  // last input arrives, without a switch between threads.
  virtual bool runs_inline() const { return false; }

  // The whole state, before an activation: Restore into a fresh node gives the same bits from there on.
  virtual void Save(base::StateWriter& out) const = 0;
  virtual void Restore(base::StateReader& in) = 0;

  // False: the state lies where nobody can read it out (a model of another maker). Save then writes what the node knows
  // of it, for the digests; its snapshots are without a state, Restore is never called, and it is computed again from
  // its first step only.
  virtual bool can_save() const { return true; }

  // A branch (X4): begins where another model of this node stood, from its own newest published samples. Called instead
  // of Initialise where the other's state does not fit. Refused unless a node knows how.
  virtual base::Status InitialiseFrom(const std::vector<Sample>& /*published*/) {
    return base::WrongInput("its state does not fit what was changed, and it cannot begin from what was published");
  }

  // For sinks: the events after the last activation, through the last step of the run (or, where the run was aborted,
  // through the last step of which everything arrived; `complete` is false then). Close files here.
  virtual base::Status Finish(const Inbox& /*rest*/, lockstep::Step /*last_step*/, bool /*complete*/) { return {}; }
};

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/runtime/lockstep/report.hpp"

namespace rodeira::lockstep {

// What happens to a node. Its phase is a function of the events so far.
enum class LifeEvent {
  kInputsComplete,  // its first samples are published, those of its sources are there
  kActivated,       // it begins an activation
  kEndReached,      // it ran to the last step of the run and has closed everything
  kRunAborted,      // the clock aborted the run, and the node has closed everything
  kFailed,          // an error of its own
  kRefused,         // an error in what a person gave
  kLost,            // its process was told to end, died or was stopped
};

// The phase after an event. An end is for good: no event changes a terminal phase, only another incarnation goes on. An
// event that does not fit (an activation before the inputs are there) changes nothing.
Phase NextPhase(Phase phase, LifeEvent event);

// Finished, aborted, failed, refused or lost.
bool IsTerminal(Phase phase);
// Failed, refused or lost.
bool IsFault(Phase phase);
// Whether a report with the phase `said` is news where `known` was reported by the same incarnation: reports overtake
// each other, and a phase never goes back.
bool MayFollow(Phase known, Phase said);
// The node has ended although `grant`, which the clock says, neither is the final one nor aborts the run.
bool EndedEarly(Phase phase, const Grant& grant);

// A node that has ended need not stay any more. One that has finished stays until the clock says that the run is over,
// or the run or the node is aborted (`grant`: as the node's mailbox says it): a part that is started again asks for
// its samples.
bool MayLeave(Phase phase, const Grant& grant);

// Why a node ends though no grant says so: an error of its own, or a signal.
struct EarlyEnd {
  LifeEvent event = LifeEvent::kFailed;  // kFailed, kRefused or kLost
  std::string reason;                    // goes on after "node 'x' …" where it is lost, else a sentence
};

}  // namespace rodeira::lockstep

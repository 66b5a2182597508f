// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/life.hpp"

namespace rodeira::lockstep {

Phase NextPhase(Phase phase, LifeEvent event) {
  if (IsTerminal(phase)) return phase;
  switch (event) {
    case LifeEvent::kInputsComplete:
      return phase == Phase::kStarting ? Phase::kReady : phase;
    case LifeEvent::kActivated:
      return phase == Phase::kReady ? Phase::kRunning : phase;
    case LifeEvent::kEndReached:
      return phase == Phase::kStarting ? phase : Phase::kFinished;
    case LifeEvent::kRunAborted:
      return Phase::kAborted;
    case LifeEvent::kFailed:
      return Phase::kFailed;
    case LifeEvent::kRefused:
      return Phase::kRefused;
    case LifeEvent::kLost:
      return Phase::kLost;
  }
  return phase;
}

bool IsTerminal(Phase phase) { return phase >= Phase::kFinished; }

bool IsFault(Phase phase) { return phase == Phase::kFailed || phase == Phase::kRefused || phase == Phase::kLost; }

bool MayFollow(Phase known, Phase said) { return said == known || (!IsTerminal(known) && said > known); }

bool EndedEarly(Phase phase, const Grant& grant) {
  return (phase == Phase::kFinished && !grant.final) || (phase == Phase::kAborted && !grant.abort);
}

bool MayLeave(Phase phase, const Grant& grant) {
  return IsTerminal(phase) && (phase != Phase::kFinished || grant.over || grant.abort);
}

}  // namespace rodeira::lockstep

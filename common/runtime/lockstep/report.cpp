// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/report.hpp"

namespace rodeira::lockstep {

std::string_view PhaseName(Phase phase) {
  switch (phase) {
    case Phase::kStarting:
      return "starting";
    case Phase::kReady:
      return "ready";
    case Phase::kRunning:
      return "running";
    case Phase::kFinished:
      return "finished";
    case Phase::kFailed:
      return "failed";
    case Phase::kRefused:
      return "refused";
    case Phase::kLost:
      return "lost";
    case Phase::kAborted:
      return "aborted";
  }
  return "unknown";
}

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/runtime/lockstep/step.hpp"

namespace rodeira::lockstep {

// What an operator may ask of a run while it goes. None of it changes a sample: it moves the grant (law L2) or is
// written down beside the samples.
struct Command {
  // kToggle pauses or resumes; kFaster and kSlower double and halve the pace, between 1/64 and 16, beyond which it is
  // 0.
  enum class Kind { kState, kPause, kResume, kStep, kPace, kMark, kStop, kToggle, kFaster, kSlower, kRestart };
  Kind kind = Kind::kState;
  Step steps = 1;     // kStep: how many base steps, at least 1
  double pace = 0.0;  // kPace: as Pacer
  std::string text;   // kMark: one line; kRestart: a node's name
};

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Time of the lockstep.

#include <cstdint>

/// Nodes in lockstep: what a node is, what it sees and what it publishes (docs/explanation/lockstep.md).
namespace rodeira::lockstep {

/// Time as an integer: the index of a base step (law L1). A sample valid at step v describes the time v * base_step_ns.
using Step = std::int64_t;

/// The time of one activation of a node with period P and delay D, both in base steps.
struct StepInfo {
  Step step = 0;             ///< step of this activation: 0, P, 2P …
  std::int64_t time_ns = 0;  ///< step * base step, exact
  Step period = 1;           ///< P
  double dt_s = 0.0;         ///< P * base step in seconds: the model advances by this time
  Step output_valid = 0;     ///< the samples of this activation are valid at this step: step + D
};

}  // namespace rodeira::lockstep

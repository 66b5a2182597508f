// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rodeira::lockstep {

// Time is an integer: the index of a base step (law L1). A sample valid at step v describes the time v * base_step_ns.
using Step = std::int64_t;

// What a node is told at an activation.
struct StepInfo {
  Step step = 0;             // this activation: 0, P, 2P …
  std::int64_t time_ns = 0;  // step * base step, exact
  Step period = 1;           // P in base steps
  double dt_s = 0.0;         // P * base step in seconds: what the model advances by
  Step output_valid = 0;     // the samples of this activation are valid at this step: step + D
};

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/runner.hpp"

namespace rodeira::lockstep {

// Runs a node to its end without a thread of its own for the steps: each piece of work is done where the last message
// that it needs arrives, which saves a switch between threads a step. For nodes that are brief (Node::runs_inline). The
// calling thread only looks after what is missing for long. Two threads never work at once.
Runner::Outcome RunInline(Runner& runner, Mailbox& mailbox, const Runner::Settings& settings);

}  // namespace rodeira::lockstep

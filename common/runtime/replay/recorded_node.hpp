// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/lockstep/node.hpp"
#include "common/runtime/replay/recorded_run.hpp"

namespace rodeira::replay {

// Stands for a node with inputs from outside (wheel, keyboard): publishes the samples that were recorded of it.
// Begins at step `from`; behind the recording's end it repeats its last samples. The run must outlive it.
std::unique_ptr<lockstep::Node> MakeRecordedNode(const RecordedRun& run, lockstep::NodeIndex node, lockstep::Step from);

// Stands for a sink of a run that is computed again: takes what it is given and does nothing.
std::unique_ptr<lockstep::Node> MakeNullSink();

}  // namespace rodeira::replay

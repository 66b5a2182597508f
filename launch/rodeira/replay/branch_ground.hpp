// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/replay/recorded_run.hpp"

namespace rodeira::cli {

// A branch at step `at` in another world: its vehicles go on where the parent's were. Wrong input where the world of
// `changed` has, below one of them, no ground, no road although the parent's has one, or ground that is more than 0.3 m
// higher or lower; and with traffic, which knows roads by their numbers, where its roads are others. The changes name
// no world: nothing is loaded.
base::Status CheckGroundOfBranch(const replay::RecordedRun& parent, const replay::RecordedRun& changed,
                                 const launch::Overrides& changes, lockstep::Step at);

}  // namespace rodeira::cli

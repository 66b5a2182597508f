// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "common/core/base/result.hpp"
#include "common/data/record/mcap_types.hpp"
#include "common/runtime/replay/recorded_run.hpp"

namespace rodeira::replay {

// The metadata record of a branch: parent, parent_roster, step, time_s, and each change.
inline constexpr const char* kBranchMetadata = "rodeira.branch";

// Wrong input where the file of a new recording exists.
base::Status CheckNewRecording(const std::filesystem::path& target);

// Writes the recording of a branch: the parent's samples valid up to `at`, then the branch's own (and the branch's
// snapshots at `at`: they are of its models), with everything else of the branch's file and `about` as its branch
// metadata. The target appears whole or not at all; an existing one is refused. Failed where it was asked to stop.
base::Status Splice(const RecordedRun& parent, const std::filesystem::path& branch, lockstep::Step at,
                    const record::TextMap& about, const std::filesystem::path& target,
                    const std::function<bool()>& stop_requested = {});

}  // namespace rodeira::replay

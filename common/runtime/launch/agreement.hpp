// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/core/base/hash.hpp"
#include "common/runtime/launch/launch.hpp"

namespace rodeira::launch {

// Whether an override says something of the run itself. Where the recording goes, how the processes meet and how long
// they wait for each other is the PC's own affair, and no bit of the run depends on it.
bool IsOfTheRun(const Launch& launch, const std::string& key);

// Of the roster, the launch file's text and the overrides that are of the run (a window may open here and not there):
// two processes with equal values mean the same run, seed and configurations included.
base::Digest Agreement(const Launch& launch);

}  // namespace rodeira::launch

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::lockstep {

// Which node waits for which, from the slowest node to the one on which all hangs: "'view' waits for 'ego', 'ego' waits
// for 'driver', 'driver' computes step 1200 since 3.2 s", and what the process of that node waits for (its message,
// from base::WaitNote). `reports` has one entry for each node. Empty where no node stands out: all wait for time.
std::string WaitChain(const Roster& roster, const std::vector<Report>& reports);

}  // namespace rodeira::lockstep

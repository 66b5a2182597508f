// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace rodeira::dds {

// Of all time-outs and periods: monotonic, so that a change of the system time has no effect.
using WallClock = std::chrono::steady_clock;

}  // namespace rodeira::dds

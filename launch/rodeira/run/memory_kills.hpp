// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rodeira::cli {

// How many processes of this machine the kernel has killed for lack of memory since it started, that of a control group
// included (proc(5): oom_kill of /proc/vmstat). 0 where it does not say.
std::uint64_t MemoryKills();

}  // namespace rodeira::cli

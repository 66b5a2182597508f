// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/runtime/launch/launch.hpp"

namespace rodeira::launch {

// The size of the shared memory from which the process of these nodes sends, KiB; without nodes: a clock or a follower.
// At most `transport.segment_kib` of the launch file; that of every process where it is more than the default, or where
// nodes may be started again. Else a process gets less where what its nodes send in two windows is known to be small:
// the DDS library writes to all of it when the process starts.
std::uint32_t SegmentKibOf(const Launch& launch, std::span<const lockstep::NodeIndex> nodes);

}  // namespace rodeira::launch

// SPDX-License-Identifier: Apache-2.0
#pragma once

// How cars stand in queues and before lines: what rooms, passages and reaches of the model count with alike.
namespace rodeira::traffic {

inline constexpr double kLoose_m = 0.5;  // more than its standing gap that a queueing car leaves
inline constexpr double kShort_m =
    0.05;  // so near before a line a front stands at the farthest, and drives on no more (StopAt)

}  // namespace rodeira::traffic

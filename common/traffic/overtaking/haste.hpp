// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::traffic {

inline constexpr double kHaste = 1.4;      // acceleration of a vehicle that overtakes, of its usual one
inline constexpr double kBackGap_s = 0.7;  // plus the minimum gap: before the passed vehicle on the way back

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#pragma once

// How the approaches to a conflict zone are judged: signs, lights and the right of way by the same limits.
namespace rodeira::lanes {

// The limits of the angle between two approaches. Below the first, both come from the same direction: they share a
// light, and they merge rather than cross. Above the second, both meet head-on.
inline constexpr double kSameDirection_rad = 0.45;
inline constexpr double kHeadOn_rad = 2.5;

// A sign or light counts for a zone at most this far upstream, over tracks without an alternative.
inline constexpr double kMaxUpstream_m = 60.0;
// A sign or light at the end of a track may stand this far behind the beginning of a zone and counts for it.
inline constexpr double kPastZoneBegin_m = 1.0;

}  // namespace rodeira::lanes

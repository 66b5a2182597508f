// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/world/network/road.hpp"

namespace rodeira::network {

// How two road ends lie to one another that go on into each other; as seen driving out of the first into the second.
struct RoadMeeting {
  double gap_m = 0.0;     // between the reference lines' ends, in plan
  double step_m = 0.0;    // up (positive) from the first one's height to the second one's
  double kink_rad = 0.0;  // of the heading, positive to the left, in (-pi, pi]
  double grade = 0.0;     // by how much the second one climbs more
};
// Of the reference lines: `end` of the first road, `contact` of the other.
RoadMeeting MeetingOf(const Road& road, End end, const Road& other, End contact);

// The end of a lane of one lane section.
struct LaneTip {
  const Road* road = nullptr;
  std::uint32_t section = 0;
  int lane = 0;
  End end = End::kStart;

  double s_m() const;
};

// How two lanes' ends lie to one another: edge to edge, the farther pair of both.
struct LaneMeeting {
  double gap_m = 0.0;   // in plan
  double step_m = 0.0;  // in height, not negative
};
LaneMeeting MeetingOf(const LaneTip& tip, const LaneTip& other);

}  // namespace rodeira::network

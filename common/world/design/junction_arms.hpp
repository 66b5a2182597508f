// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/world/design/junction_reader.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::design {

// The end of a piece of road at a junction.
struct Arm {
  std::size_t meeting = 0;  // of the junction's
  std::uint32_t piece = 0;  // index among the roads of the network
  network::End end = network::End::kStart;
};

// A lane at an arm, as its traffic sees it.
struct ArmLane {
  int id = 0;
  Eigen::Vector2d left_W, right_W;  // its edges, looking along the traffic
  double width_m = 0.0;
};

// How far from the point where the roads meet each meeting's pieces end: before it and behind it.
struct Setback {
  double before_m = 0.0, after_m = 0.0;
};
// By meeting, m.
std::vector<Setback> Setbacks(const JunctionSpec& junction, const std::vector<network::Road>& roads);

// The drivable lanes that lead into the junction, and out of it, from the left to the right as their traffic sees them.
std::vector<ArmLane> LanesOf(const network::Road& road, network::End end, bool incoming);
// The direction at the arm's end along the road, away from the junction.
Eigen::Vector2d Outward(const network::Road& road, network::End end);

}  // namespace rodeira::design

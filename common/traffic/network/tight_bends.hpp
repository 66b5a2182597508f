// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/graph.hpp"

namespace rodeira::traffic {

// Where a body's wheels have no room on a lane in its bend, however it is led through.
struct TightBend {
  std::uint32_t body = 0;
  std::uint32_t track = 0;
  double d_m = 0.0, radius_m = 0.0,
         width_m = 0.0;   // along the track; of its line in the mean over a wheelbase; of the lane
  double off_m = 0.0;     // by how much its wheels leave the lane to either side
  bool turns = true;      // whether its wheels turn so far at all
  std::size_t lanes = 0;  // on how many lanes there is such a bend
};

// Of every body that there may be the worst such bend, for cars with full physics; nothing for others. With the mean of
// both axles' circles on radius R the outsides of its tyres are w/2 + L²/(4R) from the line; ends of bends are shorter
// than that takes, so that what is off by less than a hand's breadth is left out.
std::vector<TightBend> TightBendsOf(const lanes::Graph& graph, const TrafficSettings& settings);

// The same as a sentence.
std::string Text(const TightBend& bend, const lanes::Graph& graph);

}  // namespace rodeira::traffic

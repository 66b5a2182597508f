// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/state/agent.hpp"
#include "common/world/lanes/graph.hpp"
#include "common/world/network/lights.hpp"

namespace rodeira::traffic {

// Finds vehicles with a front that passes a light that shows red, or red and amber, from one look to the next, at both.
class RedCheck {
 public:
  RedCheck(const lanes::Graph& graph, std::size_t vehicles);

  bool any_lights() const { return !lines_.empty(); }
  // Before the vehicles of a look: what the lights show, by controller.
  void Begin(std::span<const network::LightColour> colours);
  // Whether a vehicle has passed such a light since the last look, of the same trip. `front_m`: of its path's odometer.
  bool Passes(std::uint32_t id, std::uint32_t trip, const Path& path, double front_m);

 private:
  struct Line {
    double d_m = 0.0;
    std::uint32_t controller = 0;
  };
  struct Seen {
    double front_m = 0.0;
    std::int64_t trip = -1;
  };
  std::vector<std::uint32_t> first_;  // by track: its first line; one more than there are tracks
  std::vector<Line> lines_;
  std::vector<Seen> seen_;                     // by vehicle
  std::vector<std::uint8_t> stops_, stopped_;  // by controller: it is red in this look, and was in the one before
};

}  // namespace rodeira::traffic

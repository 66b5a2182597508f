// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "common/world/lanes/lights.hpp"

namespace rodeira::measures {

// The next junction and the next light on a way over the lane graph.
class WayAhead {
 public:
  // The graph outlives it.
  explicit WayAhead(const lanes::Graph& graph) : graph_(graph) {}

  // The line of a light on the way.
  struct Light {
    double d_m = 0.0;
    std::uint32_t controller = 0;  // index into the network's controllers
  };
  // From a track on, distances from its begin; up to kReach_m behind its end.
  struct Found {
    std::optional<double> junction_d_m;  // begin of the first track within a junction; 0: this track is
    std::vector<Light> lights;           // lines of lights, ascending
  };
  // later: the tracks that the vehicle is on afterwards, in order. Where a track goes on into several and none of them
  // is among these, the first is followed.
  Found From(std::uint32_t track, std::span<const std::uint32_t> later);

  static constexpr double kReach_m = 250.0;

 private:
  const std::vector<lanes::LightPlace>& LightsOn(std::uint32_t track);

  const lanes::Graph& graph_;
  std::map<std::uint32_t, std::vector<lanes::LightPlace>> lights_;
};

}  // namespace rodeira::measures

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "common/view/scene/mesh/solids.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// A traffic light as it is drawn, and the times that it follows.
struct LightHead {
  std::uint32_t controller = 0;  // index into the network's controllers; it has times
  Stand stand;                   // of the model (TrafficLightModel): its lower edge
  double height_m = 0.0;
};

// Where the model of a traffic light stands, before its post; `side` -1: its other face.
Stand StandOfLight(const Stand& post, double above_m, double height_m, double side);

// All lights of a world that controllers with times control, each side for itself, by the tiles in which they stand.
// Those for people on foot are dark.
std::vector<LightHead> LightHeads(const road::World& world);

}  // namespace rodeira::scene

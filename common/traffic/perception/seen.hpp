// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/driving/driver/footprint.hpp"
#include "common/traffic/perception/occupancy.hpp"
#include "common/traffic/perception/sight.hpp"

namespace rodeira::traffic {

// What vehicles see in a step. Nothing here is saved.
struct Seen {
  Seen(std::size_t vehicles, std::size_t tracks);
  void Forget();  // what is remembered of steps before

  // By vehicle.
  std::vector<RouteSegments> stretches;
  std::vector<WayKey> way_keys;
  std::vector<std::uint32_t> way_numbers;  // of the way in `stretches`, another one whenever that changes
  std::vector<CurrentTrackCache> below;    // the map alone says it, so that it is never wrong
  std::vector<std::uint8_t> is_overtaken;
  std::vector<Leader> ahead;
  // By track.
  Occupancy occupants;
  std::vector<std::uint8_t> parts;  // a vehicle is on a track that parts from it
  std::vector<std::vector<Block>> blocks;
  std::vector<std::vector<OncomingOvertaker>> facing;
  bool any_block = false, any_facing = false;  // on any track
  bool any_overtaking = false;
  std::vector<driver::Footprint> bodies;  // vehicles that do not drive as agents do: others, and agents that were hit
};

}  // namespace rodeira::traffic

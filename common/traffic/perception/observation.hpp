// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/base/thread_pool.hpp"
#include "common/driving/driver/footprint.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/perception/current_tracks.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/occupancy.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/perception/ways.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Puts all vehicles and other bodies on the tracks on which they are seen, and finds the leader of each vehicle.
class Observation {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const std::optional<Pedestrians>& people;
    std::span<const RouteSegments> stretches;
    base::ThreadPool* pool;
    const Neighbours& neighbours;
  };
  struct Writes {
    Occupancy& occupants;
    std::span<std::uint8_t> parts;
    std::span<std::vector<Block>> blocks;
    std::span<std::vector<OncomingOvertaker>> facing;
    bool& any_block;
    bool& any_facing;
    bool& any_overtaking;
    std::span<std::uint8_t> is_overtaken;
    std::span<Leader> ahead;
    Ways& ways;
    CurrentTracks& tracks;
  };
  Observation(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // It is seen on the lane of oncoming traffic, and the one passed keeps its speed.
  void ShowToOncoming(std::uint32_t id);
  // A vehicle is on this track: one on a track that diverges from it must look for leaders here, too.
  void Part(std::uint32_t track);
  // Sight: which vehicle is where.
  void See(std::span<const driver::Footprint> others);
  // Of all driving vehicles, on their ways as far as they see.
  void FindLeaders();

 private:
  void SeeOthers(std::span<const driver::Footprint> others);
  void BeSeen(std::uint32_t id);
  void ShowOnLaneLeft(std::uint32_t id);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic

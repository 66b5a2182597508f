// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/base/thread_pool.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/current_tracks.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Where vehicles are in the world.
class Poses {
 public:
  struct Reads {
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    const std::optional<FullCars>& full;
    std::span<const CurrentTrackCache> below;
    std::span<const AgentPose> moved;
    std::span<const std::uint8_t> is_moved;
    base::ThreadPool* pool;
    const CurrentTracks& tracks;
  };
  struct Writes {
    std::span<Agent> agents;
    std::vector<AgentPose>& poses;
  };
  Poses(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // The axles' middles stand on the path, on the road's surface; the lean across is that of the surface.
  AgentPose PoseOf(std::uint32_t id) const;
  // Level, at the height where it crashed.
  AgentPose PoseOfCrashed(std::uint32_t id) const;
  // Of all on the road and crashed, by ascending id.
  void FindPoses();

 private:
  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic

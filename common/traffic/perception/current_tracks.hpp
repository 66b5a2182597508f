// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"

namespace rodeira::traffic {

// The track below each vehicle, and the path there.
class CurrentTracks {
 public:
  struct Reads {
    const TrafficMap& map;
    std::span<const Agent> agents;
  };
  struct Writes {
    std::span<CurrentTrackCache> below;
  };
  CurrentTracks(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Brings the cache up to date with the vehicle's place. Once a step, before the others are called.
  void LookBelow(std::uint32_t id);
  // FrameAt of its path, quicker on the track that it is on.
  PathFrame FrameOf(std::uint32_t id, double odometer_m) const;
  // Whether the track has a lane beside it, on either side.
  bool HasBeside(std::uint32_t id, std::uint32_t track) const;
  // The straight on which all of it is, beside no line; null where there is none, or where its surface twists.
  const lanes::Curve::Straight* StraightBelow(std::uint32_t id) const;

 private:
  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic

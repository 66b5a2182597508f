// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/core/base/thread_pool.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motion/full_motion.hpp"
#include "common/traffic/motion/paths.hpp"
#include "common/traffic/motion/planar_motion.hpp"
#include "common/traffic/motion/poses.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"

namespace rodeira::traffic {

// The phase of motion: all vehicles that drive move by the accelerations that they want, and their poses are known.
class Motion {
 public:
  struct Reads {
    const TrafficMap& map;
    std::span<const double> wanted;
    std::span<const CurrentTrackCache> below;
    base::ThreadPool* pool;
    const Poses& body_poses;
  };
  struct Writes {
    std::span<Agent> agents;
    std::optional<FullCars>& full;
    std::span<std::uint32_t> missed_now;
    std::span<std::uint8_t> ends;
    std::span<AgentPose> moved;
    std::span<std::uint8_t> is_moved;
    std::span<std::uint8_t> at_entry;
    PlanarMotion& planar;
    FullMotion& full_motion;
    Paths& paths;
  };
  Motion(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // All driving vehicles, over dt_s, by the accelerations that were found for this step.
  void Move(double dt_s);

 private:
  void MoveOne(std::uint32_t id, double dt_s);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic

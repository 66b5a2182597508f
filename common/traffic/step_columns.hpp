// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/base/huge_pages.hpp"
#include "common/traffic/pedestrians/yielding.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/leaving.hpp"
#include "common/traffic/state/lists.hpp"
#include "common/traffic/state/vehicle_way.hpp"
#include "common/world/network/lights.hpp"

namespace rodeira::traffic {

// Data that a phase of a step passes to later phases, beside Seen and Claimed. Not part of the saved state.
struct StepColumns {
  StepColumns(std::size_t vehicles, std::size_t tracks, bool late)
      : beside(vehicles),
        passes(vehicles),
        wanted(vehicles),
        perceived(late ? vehicles : 0),
        hurries(vehicles),
        bars(vehicles, kNoBarrier_m),
        missed_now(vehicles),
        ends(vehicles),
        moved(vehicles),
        is_moved(vehicles),
        at_entry(vehicles),
        present(tracks) {
    base::PreferHugePages(moved);
  }

  std::vector<network::LightColour> colours;  // by controller
  // Controllers that never show green together, in pairs; found at the first request for a light.
  std::optional<std::vector<std::array<std::uint32_t, 2>>> conflicting_lights;
  // By vehicle.
  std::vector<std::uint8_t> beside, passes;  // may consider a lane change, overtaking
  std::vector<double> wanted;                // acceleration
  std::vector<Leader> perceived;             // as drivers see them; empty without a reaction time
  std::vector<std::uint8_t> hurries;         // brakes in an emergency
  std::vector<double> bars;                  // odometer at which it waits for pedestrians
  std::vector<std::uint32_t> missed_now;
  std::vector<Leaver> leavers;            // that left in the step, by ascending number
  std::vector<std::uint32_t> removals;    // asked for before the step, ascending
  std::vector<std::uint8_t> ends;         // has come to the end of its last lane
  std::vector<AgentPose> moved;           // where the step has brought it …
  std::vector<std::uint8_t> is_moved;     // … if that is known, and it has not left or been hit since
  std::vector<Eigen::Vector2d> segments;  // where the driver of MOTORS looks to
  std::vector<std::uint8_t> at_entry;     // is on a track where vehicles may begin their way
  // Of crossings for people on foot.
  std::vector<AtCrossing> at_crossings;
  std::vector<ToCrossing> to_crossings;
  // By track, while vehicles enter.
  Lists<std::uint32_t> present;        // vehicles on it
  std::vector<std::uint8_t> expected;  // a vehicle is on the way to its beginning
};

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/overtaking/overtaking.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/world/lanes/graph.hpp"

// Short answers about tracks and the vehicles on them.
namespace rodeira::traffic {

inline constexpr double kWithout_m = 1e-9;  // odometers nearer to one another are equal

// `blocks` is by track; any_block: false where none of them has one.
inline std::span<const Block> BlocksOn(bool any_block, std::span<const std::vector<Block>> blocks,
                                       std::uint32_t track) {
  return any_block ? std::span<const Block>(blocks[track]) : std::span<const Block>();
}
// What stands or drives on a track, as the next vehicle on a way.
inline Leader LeaderOf(const Block& block, double gap_m) {
  return {gap_m,
          block.span.speed_mps,
          -1,
          true,
          block.body,
          block.span.front_m - block.span.rear_m,
          block.span.left_m,
          block.span.right_m};
}
// Of a track, m; the cache spares a look into the graph.
inline double LengthOf(const lanes::Graph& graph, const CurrentTrackCache& below, std::uint32_t track) {
  return below.track == track ? below.length_m : graph[track].length_m();
}
// Whether any track follows.
inline bool GoesOn(const lanes::Graph& graph, const CurrentTrackCache& below, std::uint32_t track) {
  return below.track == track ? below.goes_on : !graph[track].next.empty();
}
// Whether a vehicle ahead, by its id or that of its body, is the one that is overtaken, and has been cleared already.
inline bool IsPassed(const Overtaking& overtaking, double front_m, std::int64_t id, std::int64_t body, double gap_m) {
  const bool same = (id >= 0 && id == overtaking.passed) || (body >= 0 && body == overtaking.passed_body);
  return same && !overtaking.back && front_m >= overtaking.clear_m && (!overtaking.gives_up || gap_m <= 0.0);
}
// Whether one that stands is before the place where the path out has cleared it: then the way to there is free.
inline bool IsCleared(const Overtaking& overtaking, double front_m, std::int64_t body, double gap_m, double speed_mps) {
  return body >= 0 && body == overtaking.passed_body && !overtaking.back && !overtaking.gives_up &&
         std::fabs(speed_mps) < kStandingLeader_mps && front_m + gap_m >= overtaking.clear_m + kPassingBy_m;
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
// Followers, and the vehicle that is overtaken.
#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/seen_on.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {

Follower Neighbours::FindFollower(std::uint32_t id, std::uint32_t track, double middle_m, double rear_m) const {
  Follower behind;
  bool here = false;  // one farther back on the same branch is no follower
  const auto consider = [&](std::int64_t other, std::uint32_t on, double d_m, double gap_m, double speed_mps) {
    here = true;
    if (gap_m < in_.settings.sight_m && (!behind.any || gap_m < behind.gap_m))
      behind = {gap_m, speed_mps, other, on, d_m, true};
  };
  struct At {
    std::uint32_t track;
    double middle_m, rear_m;
  };
  std::vector<At> open{{track, middle_m, rear_m}};
  for (std::size_t i = 0; i < open.size() && i < 32; ++i) {
    const At at = open[i];
    here = false;
    const auto all = in_.occupants.On(at.track);
    for (std::size_t k = all.size() - in_.occupants.Beyond(at.track, at.middle_m).size(); k-- > 0;) {
      if (all[k].id == id) continue;
      consider(all[k].id, at.track, all[k].front_m, at.rear_m - all[k].front_m, in_.agents[all[k].id].speed_mps);
      break;
    }
    for (const Block& block : in_.blocks[at.track]) {
      if (block.middle_m >= at.middle_m || block.span.right_m > kOnLaneOffset_m || block.span.left_m < -kOnLaneOffset_m)
        continue;
      consider(-1, at.track, block.span.front_m, at.rear_m - block.span.front_m, block.span.speed_mps);
    }
    if (here ||
        at.rear_m - in_.longest_half_m > std::min(in_.settings.sight_m, behind.any ? behind.gap_m : kNoBarrier_m))
      continue;
    for (const std::uint32_t before : in_.map.graph[at.track].before) {
      for (const lanes::Link& link : in_.map.graph[before].next) {
        const double further = in_.map.graph[before].length_m() - link.from_d_m;
        if (link.to == at.track) open.push_back({before, at.middle_m + further, at.rear_m + further});
      }
    }
  }
  return behind;
}

std::optional<Leader> Neighbours::FindOvertaken(std::uint32_t id) const {
  const Overtaking& way = in_.agents[id].overtaking;
  const double front = in_.agents[id].o_m + 0.5 * in_.traits[id].length_m;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    for (const Occupant& other : in_.occupants.On(stretch.track)) {
      if (other.id == way.passed)
        return Leader{stretch.zero_m + other.rear_m - front, in_.agents[other.id].speed_mps, other.id, true, -1,
                      other.front_m - other.rear_m};
    }
    for (const Block& block : in_.blocks[stretch.track]) {
      if (block.body == way.passed_body) return LeaderOf(block, stretch.zero_m + block.span.rear_m - front);
    }
  }
  return std::nullopt;
}

}  // namespace rodeira::traffic

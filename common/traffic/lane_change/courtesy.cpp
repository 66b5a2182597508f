// SPDX-License-Identifier: Apache-2.0
// Gaps for vehicles on the lane beside that must change lanes for their route.
#include <algorithm>

#include "common/driving/driver/idm.hpp"
#include "common/traffic/lane_change/lane_changes.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kCourtesy_mps2 = 1.0;   // braking to make room, at most
constexpr double kCourtesyRoom_m = 1.0;  // beyond the gap in which it would stand behind the vehicle that it lets in
constexpr double kQueued_mps = 1.0, kQueued_m = 12.0;  // a vehicle so slow and so near to such a one cannot change yet

}  // namespace

double LaneChanges::WantedCourteous(std::uint32_t id, double limit_mps) const {
  const Agent& agent = out_.agents[id];
  const AgentTraits& traits = in_.traits[id];
  double wanted = traits.idm.max_deceleration_mps2;
  const double front = FrontOf(out_.agents[id], in_.traits[id]);
  const auto beside_it = [&](const RouteSegment& stretch) { return stretch.has_beside && stretch.begin_m <= front; };
  if (agent.change.side != 0 || std::none_of(out_.stretches[id].begin(), out_.stretches[id].end(), beside_it))
    return wanted;
  const auto is_queued = [&](std::uint32_t other) {
    const Leader& ahead = out_.ahead[other];
    return ahead.any && out_.agents[other].speed_mps < kQueued_mps && ahead.speed_mps < kQueued_mps &&
           ahead.gap_m < kQueued_m;
  };
  const Piece& here = agent.path.back();
  const lanes::Track& track = in_.map.graph[here.track];
  const double d = agent.o_m - here.zero_m;
  for (const auto& beside : {track.left, track.right}) {
    if (!beside) continue;
    const double there = in_.map.graph.Across(here.track, d, *beside);
    for (const Occupant& other : out_.occupants.Beyond(*beside, there)) {
      if (other.id == id || other.middle_m() <= there) continue;
      const double gap = other.rear_m - there - 0.5 * traits.length_m;
      if (gap >= out_.ahead[id].gap_m) break;
      if (in_.lanes_beside.IsShutIn(other.id) || (is_queued(other.id) && !GoesRound(other.id))) continue;
      if (out_.agents[other.id].seeks && gap > traits.idm.min_gap_m &&
          (in_.lanes_beside.FewerChanges(other.id, here.track) > 0 || in_.lanes_beside.EndAhead(other.id) ||
           GoesRound(other.id))) {
        wanted = std::min(wanted, std::max(-kCourtesy_mps2, driver::IdmAcceleration(traits.idm, agent.speed_mps,
                                                                                    limit_mps, gap - kCourtesyRoom_m,
                                                                                    out_.agents[other.id].speed_mps)));
      }
      break;
    }
  }
  return wanted;
}

}  // namespace rodeira::traffic

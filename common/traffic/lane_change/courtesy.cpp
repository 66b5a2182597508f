// SPDX-License-Identifier: Apache-2.0
// Room for those on the lane beside who must come over for their route.
#include <algorithm>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kCourtesy_mps2 = 1.0;  // braking of who makes room, at most

}  // namespace

// The next one on a lane beside, who finds no gap, is nearer than who is ahead and must come over to this lane, is let
// in: followed by braking gently.
double TrafficModel::WantedCourteous(std::uint32_t id, double limit_mps) const {
  const Agent& agent = agents_[id];
  const AgentTraits& traits = traits_[id];
  double wanted = traits.idm.hardest_mps2;
  const double front = FrontOf(id);
  const auto beside_it = [&](const Stretch& stretch) { return stretch.has_beside && stretch.begin_m <= front; };
  if (agent.change.side != 0 || std::none_of(stretches_[id].begin(), stretches_[id].end(), beside_it)) return wanted;
  const Piece& here = agent.path.back();
  const lanes::Track& track = graph()[here.track];
  const double d = agent.o_m - here.zero_m;
  for (const auto& beside : {track.left, track.right}) {
    if (!beside) continue;
    const double there = graph().Across(here.track, d, *beside);
    for (const Occupant& other : occupants_.Beyond(*beside, there)) {
      if (other.id == id || other.middle_m() <= there) continue;
      const double gap = other.rear_m - there - 0.5 * traits.length_m;
      if (agents_[other.id].seeks && gap < ahead_[id].gap_m && FewerChanges(other.id, here.track) > 0) {
        wanted =
            std::min(wanted, std::max(-kCourtesy_mps2, driver::IdmAcceleration(traits.idm, agent.speed_mps, limit_mps,
                                                                               gap, agents_[other.id].speed_mps)));
      }
      break;
    }
  }
  return wanted;
}

}  // namespace rodeira::traffic

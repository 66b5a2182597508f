// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/paths.hpp"

#include "common/traffic/perception/seen_on.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {

std::uint32_t Paths::Follow(std::uint32_t id) {
  std::uint32_t missed = 0;
  Agent& agent = out_.agents[id];
  const double half = 0.5 * in_.traits[id].length_m;
  while (true) {
    const Piece& last = agent.path.back();
    if (agent.o_m + half <= last.zero_m + LengthOf(in_.map.graph, in_.below[id], last.track) ||
        !GoesOn(in_.map.graph, in_.below[id], last.track))
      break;
    const Route* route = RouteOf(in_.map, agent);
    if (route != nullptr && route->MustChange(agent.leg, last.track)) ++missed;
    Choice choice{agent.links, agent.leg};
    const lanes::Link& link = NextLink(in_.map, in_.settings.seed, id, out_.agents[id], last.track, choice);
    agent.path.push_back(Onward(in_.map.graph, agent.path, link, agent.speed_mps));
    agent.links = choice.link, agent.leg = choice.leg;
    agent.seeks = false;
  }
  while (agent.path.size() > 1 && agent.path[1].begin_m < agent.o_m - half - 1.0) agent.path.erase(agent.path.begin());
  return missed;
}

bool Paths::AtTheEnd(std::uint32_t id) const {
  const Agent& agent = out_.agents[id];
  const Piece& last = agent.path.back();
  const double front_m = agent.o_m + 0.5 * in_.traits[id].length_m - last.zero_m;
  if (front_m >= in_.map.lane_ends.NarrowsFrom_m(last.track)) return true;
  return !GoesOn(in_.map.graph, in_.below[id], last.track) &&
         front_m >= LengthOf(in_.map.graph, in_.below[id], last.track);
}

}  // namespace rodeira::traffic

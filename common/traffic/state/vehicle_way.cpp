// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/state/vehicle_way.hpp"

#include <optional>

#include "common/core/base/random.hpp"
#include "common/traffic/demand/requested_route.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawLink = 103;

}  // namespace

const Route* RouteOf(const TrafficMap& map, const Agent& agent) {
  if (agent.requested) return &agent.requested->route;
  if (agent.flow < 0) return nullptr;
  const std::int64_t route = map.demand.flows()[static_cast<std::size_t>(agent.flow)].route;
  return route < 0 ? nullptr : &map.demand.route(route);
}

const lanes::Link& NextLink(const TrafficMap& map, std::uint64_t seed, std::uint32_t id, const Agent& agent,
                            std::uint32_t track, Choice& choice) {
  const auto& next = map.graph[track].next;
  const Route* route = RouteOf(map, agent);
  std::optional<std::size_t> chosen = route != nullptr ? route->LinkOn(map.graph, choice.leg, track) : std::nullopt;
  if (!chosen) {
    const double draw = base::RandomUniform({seed, id, kDrawLink, agent.trip, choice.link});
    const auto shares = map.demand.Shares(track);
    if (shares.empty())
      chosen = static_cast<std::size_t>(draw * static_cast<double>(next.size()));
    else
      chosen = std::min<std::size_t>(
          static_cast<std::size_t>(std::upper_bound(shares.begin(), shares.end(), draw) - shares.begin()),
          next.size() - 1);
  }
  const lanes::Link& link = next[*chosen];
  ++choice.link;
  if (route != nullptr) choice.leg = route->LegOn(choice.leg, link.to);
  return link;
}

}  // namespace rodeira::traffic

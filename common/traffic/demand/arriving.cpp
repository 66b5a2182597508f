// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/arriving.hpp"

#include <cstddef>

#include "common/core/base/random.hpp"
#include "common/traffic/demand/arrivals.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawFlowLane = 105;
constexpr std::uint64_t kOfFlows = 1ull << 32;  // keys of vehicles of flows lie beyond all others

}  // namespace

void Arriving::BeginFlows() {
  out_.flows.resize(in_.settings.demand.flows.size());
  for (std::size_t f = 0; f < out_.flows.size(); ++f)
    out_.flows[f].next_ns = NextArrival_ns(in_.settings.demand.flows[f], in_.settings.seed, f, 0, 0);
}

// An arrival is given a vehicle that is not in use, by ascending numbers of flows and vehicles.
void Arriving::Arrive(std::int64_t until_ns) {
  std::uint32_t id = 0;
  for (std::uint32_t f = 0; f < out_.flows.size(); ++f) {
    FlowCount& flow = out_.flows[f];
    while (flow.next_ns >= 0 && flow.next_ns < until_ns) {
      flow.next_ns = NextArrival_ns(in_.settings.demand.flows[f], in_.settings.seed, f, ++flow.arrived, flow.next_ns);
    }
    for (; flow.given < flow.arrived && id < in_.settings.vehicles; ++id) {
      if (out_.agents[id].flow < 0) Begin(id, f, flow.given++);
    }
  }
}

void Arriving::Begin(std::uint32_t id, std::uint32_t flow, std::uint32_t arrival) {
  Agent& agent = out_.agents[id];
  agent.flow = static_cast<std::int32_t>(flow);
  agent.arrival = arrival;
  const std::int64_t track = in_.map.demand.flows()[flow].track;
  if (track >= 0) {
    agent.entry = static_cast<std::uint32_t>(track);
  } else {
    agent.entry = in_.map.DrawEntry(base::RandomBits({in_.settings.seed, flow, kDrawFlowLane, arrival}));
  }
  if (const Route* route = RouteOf(in_.map, agent)) agent.leg = route->LegOn(0, agent.entry);
  out_.traits[id] = TraitsFor(id);
  out_.waiting.push_back(id);
}

AgentTraits Arriving::TraitsFor(std::uint32_t id) const {
  const Agent& agent = out_.agents[id];
  if (agent.flow < 0) return TraitsOf(in_.settings, id);
  const auto flow = static_cast<std::uint64_t>(agent.flow);
  const auto& mix = in_.settings.demand.flows[flow].mix;
  return TraitsOf(in_.settings, mix ? *mix : in_.settings.mix, kOfFlows * (flow + 1) + agent.arrival);
}

}  // namespace rodeira::traffic

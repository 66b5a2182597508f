// SPDX-License-Identifier: Apache-2.0
// How vehicles of flows arrive.
#include "common/core/base/random.hpp"
#include "common/traffic/demand/arrivals.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawFlowLane = 105;
constexpr std::uint64_t kOfFlows = 1ull << 32;  // keys of vehicles of flows lie beyond all others

}  // namespace

void TrafficModel::BeginFlows() {
  flows_.resize(settings_.demand.flows.size());
  for (std::size_t f = 0; f < flows_.size(); ++f)
    flows_[f].next_ns = NextArrival_ns(settings_.demand.flows[f], settings_.seed, f, 0, 0);
}

// Who has arrived is given a vehicle that is not in use, by ascending numbers of flows and vehicles.
void TrafficModel::Arrive(std::int64_t until_ns) {
  std::uint32_t id = 0;
  for (std::uint32_t f = 0; f < flows_.size(); ++f) {
    FlowCount& flow = flows_[f];
    while (flow.next_ns >= 0 && flow.next_ns < until_ns) {
      flow.next_ns = NextArrival_ns(settings_.demand.flows[f], settings_.seed, f, ++flow.arrived, flow.next_ns);
    }
    for (; flow.given < flow.arrived && id < settings_.vehicles; ++id) {
      if (agents_[id].flow < 0) Begin(id, f, flow.given++);
    }
  }
}

void TrafficModel::Begin(std::uint32_t id, std::uint32_t flow, std::uint32_t arrival) {
  Agent& agent = agents_[id];
  agent.flow = static_cast<std::int32_t>(flow);
  agent.arrival = arrival;
  const std::int64_t track = map_->demand.flows()[flow].track;
  if (track >= 0) {
    agent.entry = static_cast<std::uint32_t>(track);
  } else {
    agent.entry = map_->DrawEntry(base::RandomBits({settings_.seed, flow, kDrawFlowLane, arrival}));
  }
  if (const Route* route = RouteOf(agent)) agent.leg = route->LegOn(0, agent.entry);
  traits_[id] = TraitsFor(id);
  waiting_.push_back(id);
}

AgentTraits TrafficModel::TraitsFor(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  if (agent.flow < 0) return TraitsOf(settings_, id);
  const auto flow = static_cast<std::uint64_t>(agent.flow);
  const auto& mix = settings_.demand.flows[flow].mix;
  return TraitsOf(settings_, mix ? *mix : settings_.mix, kOfFlows * (flow + 1) + agent.arrival);
}

}  // namespace rodeira::traffic

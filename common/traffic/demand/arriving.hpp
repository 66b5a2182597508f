// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/flow_count.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Vehicles of flows arrive, by Poisson, even or uniform gaps.
class Arriving {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
  };
  struct Writes {
    std::span<Agent> agents;
    std::span<AgentTraits> traits;
    std::vector<std::uint32_t>& waiting;
    std::vector<FlowCount>& flows;
  };
  Arriving(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Before the first Arrive: draws when each flow's first vehicle comes.
  void BeginFlows();
  // All that come before this time, ns since the run's beginning. Those without a free vehicle come later.
  void Arrive(std::int64_t until_ns);
  // Of its present flow; drawn by the settings' seed, so that each call gives the same.
  AgentTraits TraitsFor(std::uint32_t id) const;

 private:
  void Begin(std::uint32_t id, std::uint32_t flow, std::uint32_t arrival);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/map_demand.hpp"

#include <fmt/format.h>

namespace rodeira::traffic {

DemandSettings DemandOf(const traffic_map::Heights& companion, const std::filesystem::path& file) {
  DemandSettings demand;
  for (const traffic_map::LaneFlow& lane_flow : companion.flows) {
    FlowSettings flow;
    flow.lane = std::to_string(lane_flow.lane);  // the road that the lane becomes
    flow.per_h = {lane_flow.vehph};
    flow.place = fmt::format("{}:{}", file.string(), lane_flow.line);
    demand.flows.push_back(std::move(flow));
  }
  return demand;
}

}  // namespace rodeira::traffic

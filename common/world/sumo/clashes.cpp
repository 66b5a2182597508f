// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/clashes.hpp"

#include "common/world/lanes/graph.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/lanes/zones.hpp"

namespace rodeira::sumo {

std::set<std::string> ClashingLights(const network::Network& network,
                                     const std::map<std::string, std::string>& light_of) {
  if (light_of.empty()) return {};
  const lanes::Graph graph(network);
  const auto together = lanes::FindGreenTogether(graph, lanes::Zones(graph));
  std::set<std::string> lights;
  if (!together) return lights;
  for (const std::uint32_t controller : together->controllers) {
    const auto light = light_of.find(network.controllers()[controller].id);
    if (light != light_of.end()) lights.insert(light->second);
  }
  return lights;
}

}  // namespace rodeira::sumo

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/signals/map_lights.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "common/world/lanes/lights.hpp"
#include "common/world/traffic_map/heights.hpp"
#include "common/world/traffic_map/map_network.hpp"

namespace rodeira::traffic {
namespace {

bool IsGreen(const lights::Phase& phase, const std::string& name) {
  return std::find(phase.green.begin(), phase.green.end(), name) != phase.green.end();
}

// The phase in which both are green; where amber meets green, or they have different plans, the first in which the
// second one is.
const lights::Phase* PhaseOf(const traffic_map::Heights& companion, const std::array<std::string, 2>& names) {
  const lights::Phase* found = nullptr;
  for (const lights::LightPlan& plan : companion.lights) {
    for (const lights::Phase& phase : plan.phases) {
      if (!IsGreen(phase, names[1])) continue;
      if (IsGreen(phase, names[0])) return &phase;
      if (found == nullptr) found = &phase;
    }
  }
  return found;
}

}  // namespace

std::optional<traffic_map::Finding> LightsTogether(const traffic_map::LaneMap& map,
                                                   const traffic_map::Heights& companion,
                                                   const network::Network& network) {
  if (map.lights.empty()) return std::nullopt;
  const lanes::Graph graph(network);
  const auto together = lanes::FindGreenTogether(graph, lanes::Zones(graph));
  if (!together) return std::nullopt;
  std::array<std::string, 2> names;
  for (std::size_t i = 0; i < names.size(); ++i)
    names[i] = std::to_string(map.lanes[map.lights[together->controllers[i]].lane].id);  // a light, a controller
  const lights::Phase* phase = PhaseOf(companion, names);
  return traffic_map::Finding{traffic_map::Severity::kError,
                              traffic_map::Element::kLights,
                              0,
                              0,
                              phase == nullptr ? 0 : traffic_map::LineOf(phase->place),
                              "world.wrong_signals",
                              together->sentence};
}

base::Status CheckLightsOfMap(const std::filesystem::path& path) {
  const auto companion = traffic_map::LoadHeightsOf(path);
  if (!companion) return companion.error();
  if (companion.value().lights.empty()) return {};
  const auto made = traffic_map::LoadLaneMap(path);
  if (!made) return made.error();
  const auto network = traffic_map::ToNetwork(made.value(), path.string());
  if (!network) return network.error();
  const auto wrong = LightsTogether(made.value(), companion.value(), *network.value());
  if (wrong) return base::WrongInput(wrong->id, wrong->Text(), wrong->Place(path.string()));
  return {};
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/state/vehicle_store.hpp"

#include <algorithm>

#include "common/core/base/huge_pages.hpp"

namespace rodeira::traffic {

VehicleStore::VehicleStore(const TrafficSettings& settings) : agents(settings.vehicles + settings.scripted.size()) {
  for (std::uint32_t id = 0; id < agents.size(); ++id) traits.push_back(TraitsOf(settings, id));
  for (const AgentTraits& of : traits) longest_half_m = std::max(longest_half_m, 0.5 * of.length_m);
  if (!settings.demand.flows.empty()) longest_half_m = 0.5 * LargestOf(settings).length_m;
  if (settings.decide_s > 0.0) decided.resize(agents.size());
  if (settings.pedestrians) yielding.resize(agents.size());
  base::PreferHugePages(agents);
  base::PreferHugePages(traits);
}

}  // namespace rodeira::traffic

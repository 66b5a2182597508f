// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/way_ahead.hpp"

#include <algorithm>

#include "common/analysis/measures/preferred.hpp"

namespace rodeira::measures {

const std::vector<lanes::LightPlace>& WayAhead::LightsOn(std::uint32_t track) {
  const auto known = lights_.find(track);
  if (known != lights_.end()) return known->second;
  return lights_.emplace(track, lanes::LightsOf(graph_, track)).first->second;
}

WayAhead::Found WayAhead::From(std::uint32_t track, std::span<const std::uint32_t> later) {
  constexpr int kMaxTracks = 200;
  Found found;
  const double reach_m = graph_[track].length_m() + kReach_m;
  double begin_m = 0.0;
  for (int i = 0; i < kMaxTracks && begin_m <= reach_m; ++i) {
    if (!found.junction_d_m && graph_[track].junction >= 0) found.junction_d_m = begin_m;
    for (const lanes::LightPlace& light : LightsOn(track)) {
      if (begin_m + light.d_m <= reach_m) found.lights.push_back({begin_m + light.d_m, light.controller});
    }
    const auto& links = graph_[track].next;
    const auto next = Preferred(links, later, [](const lanes::Link& link) { return link.to; });
    if (!next) break;
    begin_m += graph_[track].length_m() - std::ranges::find(links, *next, &lanes::Link::to)->from_d_m;
    track = *next;
  }
  std::ranges::sort(found.lights, {}, &Light::d_m);
  return found;
}

}  // namespace rodeira::measures

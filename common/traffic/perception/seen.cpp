// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/perception/seen.hpp"

#include "common/core/base/huge_pages.hpp"

namespace rodeira::traffic {

Seen::Seen(std::size_t vehicles, std::size_t tracks)
    : stretches(vehicles),
      way_keys(vehicles),
      way_numbers(vehicles, 1),
      below(vehicles),
      is_overtaken(vehicles),
      ahead(vehicles),
      occupants(tracks),
      parts(tracks),
      blocks(tracks),
      facing(tracks) {
  base::PreferHugePages(stretches);
  base::PreferHugePages(way_keys);
  base::PreferHugePages(below);
  base::PreferHugePages(ahead);
}

void Seen::Forget() {
  for (WayKey& key : way_keys) key = {};
  for (RouteSegments& stretch : stretches) stretch = {};
  for (CurrentTrackCache& track : below) track = {};
}

}  // namespace rodeira::traffic

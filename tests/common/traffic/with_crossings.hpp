// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::traffic {

// A network with crossings for people on foot across every road outside of junctions that is longer than 40 m: 14 m
// from its ends, and every 300 m between.
inline std::shared_ptr<const network::Network> WithCrossings(const network::Network& network) {
  constexpr double kFromEnd_m = 14.0, kEvery_m = 300.0, kShortest_m = 40.0;
  network::NetworkSpec spec;
  spec.name = network.name();
  spec.geo_reference = network.geo_reference();
  spec.geo_offset = network.geo_offset();
  spec.junctions.assign(network.junctions().begin(), network.junctions().end());
  spec.controllers.assign(network.controllers().begin(), network.controllers().end());
  for (const network::Road& road : network.roads()) {
    network::RoadSpec with = road.spec();
    std::vector<double> places;
    if (with.junction.empty() && road.length_m() > kShortest_m) {
      for (double s = kFromEnd_m; s < road.length_m() - kFromEnd_m - kEvery_m / 3.0; s += kEvery_m) places.push_back(s);
      places.push_back(road.length_m() - kFromEnd_m);
    }
    for (const double s : places) {
      double left = -1e9, right = 1e9;
      const std::size_t section = road.SectionIndex(s);
      for (const auto* side : {&with.sections[section].left, &with.sections[section].right}) {
        for (const network::Lane& lane : *side) {
          const auto span = network::IsDrivable(lane.type) ? road.SpanAt(section, lane.id, s) : std::nullopt;
          if (span)
            left = std::max({left, span->inner_t_m, span->outer_t_m}),
            right = std::min({right, span->inner_t_m, span->outer_t_m});
        }
      }
      if (!(left > right)) continue;
      network::Object object;
      object.id = with.id + "-z" + std::to_string(static_cast<int>(s));
      object.type = "crosswalk";
      object.s_m = s, object.t_m = 0.5 * (left + right);
      object.length_m = 4.0, object.width_m = left - right;
      with.objects.push_back(std::move(object));
    }
    spec.roads.emplace_back(std::move(with), road.axis());
  }
  return std::make_shared<const network::Network>(std::move(spec));
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/places_across.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rodeira::road {
namespace {

constexpr double kStationStep_m = 1.0;
constexpr double kMaxSteps = 1e6;
constexpr double kInset_m = 0.1;

}  // namespace

std::vector<double> PlacesAcross(const network::Road& road, std::uint32_t section, double s_m) {
  std::vector<double> across;
  double right = std::numeric_limits<double>::infinity(), left = -right;
  for (const auto* side : {&road.spec().sections[section].left, &road.spec().sections[section].right}) {
    for (const network::Lane& lane : *side) {
      if (!network::IsDrivable(lane.type)) continue;
      const network::LaneSpan span = *road.SpanAt(section, lane.id, s_m);
      if (span.width_m() < 2.0 * kInset_m) continue;
      across.push_back(span.centre_t_m());
      right = std::min({right, span.inner_t_m, span.outer_t_m}),
      left = std::max({left, span.inner_t_m, span.outer_t_m});
    }
  }
  if (!across.empty()) across.push_back(right + kInset_m), across.push_back(left - kInset_m);
  return across;
}

std::vector<double> StationsLookedAt(const network::Road& road) {
  const int steps = std::max(1, static_cast<int>(std::min(kMaxSteps, std::ceil(road.length_m() / kStationStep_m))));
  std::vector<double> stations;
  for (int i = 0; i <= steps; ++i) stations.push_back(road.length_m() * i / steps);
  return stations;
}

}  // namespace rodeira::road

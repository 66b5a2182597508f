// SPDX-License-Identifier: Apache-2.0
// Lanes and roads by their names.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "common/core/base/suggest.hpp"
#include "common/traffic/demand/demand.hpp"

namespace rodeira::traffic {

base::Result<std::vector<std::uint32_t>> TracksOf(const lanes::Graph& graph, const std::string& way,
                                                  const std::string& place) {
  const auto colon = way.rfind(':');
  int lane = 0;
  const char* end = way.data() + way.size();
  const bool of_lane = colon != std::string::npos && std::from_chars(way.data() + colon + 1, end, lane).ptr == end &&
                       colon + 1 < way.size();
  std::vector<std::uint32_t> tracks;
  std::vector<std::string> known;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const network::LaneKey& key = graph[track].lane;
    const std::string& id = graph.network().roads()[key.road].id();
    if (id == way || (of_lane && key.lane == lane && id == std::string_view(way).substr(0, colon)))
      tracks.push_back(track);
    known.push_back(of_lane ? fmt::format("{}:{}", id, key.lane) : id);
  }
  if (tracks.empty()) {
    return base::WrongInput("world.unknown_lane",
                            fmt::format("'{}' was found; a drivable lane as ROAD:LANE, or a road, was expected{}", way,
                                        base::DidYouMean(way, known)),
                            place);
  }
  std::stable_sort(tracks.begin(), tracks.end(), [&](std::uint32_t a, std::uint32_t b) {
    const lanes::Track &one = graph[a], &other = graph[b];
    if (one.along != other.along) return one.along;
    return one.along ? one.lane.section < other.lane.section : one.lane.section > other.lane.section;
  });
  return tracks;
}

}  // namespace rodeira::traffic

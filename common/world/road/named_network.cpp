// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/named_network.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "common/core/base/suggest.hpp"
#include "common/world/road/network_world.hpp"

namespace rodeira::road {
namespace {

using config::Map;

// On a road: its first lane and its beginning where nothing else is said.
void PutStartOnNetwork(const Map& map, const design::StartSpec& start_spec, const network::Network& network,
                       StartPose& start) {
  const auto& roads = network.roads();
  std::vector<std::string> ids;
  std::uint32_t at = 0;
  for (; at < roads.size() && !start_spec.road.empty() && roads[at].id() != start_spec.road; ++at)
    ids.push_back(roads[at].id());
  if (at == roads.size())
    return map.Problem("road", "world.unknown_road",
                       fmt::format("there is no road '{}'{}", start_spec.road, base::DidYouMean(start_spec.road, ids)));
  const double s_m = start_spec.s_m.value_or(0.0);
  if (s_m > roads[at].length_m())
    return map.Problem("s_m", "config.out_of_range",
                       fmt::format("'start.s_m' is {}; the road is {:.3f} m long", s_m, roads[at].length_m()));
  const network::LaneKey key{at, static_cast<std::uint32_t>(roads[at].SectionIndex(s_m)), start_spec.lane.value_or(-1)};
  const network::Lane* lane = network.Find(key);
  if (lane == nullptr || !network::IsDrivable(lane->type))
    return map.Problem("lane", "world.unknown_lane",
                       fmt::format("road '{}' has no lane {} to drive on there", roads[at].id(), key.lane));
  start = PoseOn(network, key, s_m);
}

}  // namespace

WorldReading ReadNamedNetwork(const config::File& file, const std::filesystem::path& network_file, WorldSpec said,
                              const design::StartSpec& start_spec) {
  WorldReading reading;
  reading.problems = file.Problems();
  if (!reading.problems.empty()) return reading;
  auto spec = ReadNetworkWorld(network_file);
  if (!spec) {
    reading.problems.push_back(spec.error().In(file.root().Child("network").Place("file")));
    return reading;
  }
  const Map start = file.root().OptionalChild("start");
  if (start.Has("x_m"))
    spec.value().start = said.start;
  else if (file.root().Has("start"))
    PutStartOnNetwork(start, start_spec, *spec.value().network, spec.value().start);
  spec.value().name = said.name;
  spec.value().friction = said.friction;
  reading.problems = file.Problems();
  if (reading.problems.empty()) reading.spec = std::move(spec).value();
  return reading;
}

}  // namespace rodeira::road

#include "common/traffic/traffic_map.hpp"

#include <algorithm>
#include <utility>

namespace rodeira::traffic {
namespace {

constexpr double kEntryClear_m = 12.0;  // from a lane's beginning to its first conflict zone

}  // namespace

TrafficMap::TrafficMap(std::shared_ptr<const network::Network> of, const TrafficSettings& settings)
    : network(std::move(of)), graph(*network), zones(graph, LargestOf(settings)), marks(graph), opposites(lanes::Opposites(graph)), no_overtaking(graph) {
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) plans.emplace_back(graph, track, settings.speed);
  for (const bool clear : {true, false}) {
    for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
      const bool early = std::any_of(zones.Of(track).begin(), zones.Of(track).end(), [&](const lanes::ZoneSide& side) {
        return zones[side.zone].in_m[static_cast<std::size_t>(side.side)] < kEntryClear_m;
      });
      if (graph[track].entry && !(clear && early)) entries.push_back(track);
    }
    if (!entries.empty()) break;
  }
  enters.resize(graph.tracks().size());
  for (std::uint32_t track = 0; track < enters.size(); ++track) enters[track] = graph[track].entry;
}

}  // namespace rodeira::traffic

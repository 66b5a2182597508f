// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/network/traffic_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/base/huge_pages.hpp"
#include "common/core/base/random.hpp"
#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/network/long_enough.hpp"
#include "common/traffic/network/swing.hpp"
#include "common/world/lanes/approach.hpp"
#include "common/world/lanes/ring.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kEntryClear_m = 12.0;  // from a lane's beginning to its first conflict zone
constexpr double kAlike = 0.9;          // cosine between the approaches of lanes that merge with equal right

bool Zips(const lanes::Graph& graph, const lanes::Zone& zone) {
  if (zone.kind != lanes::ZoneKind::kMerge || zone.signed_ ||
      lanes::OnRing(graph, zone.track[0]) != lanes::OnRing(graph, zone.track[1]))
    return false;
  return graph[zone.track[0]].curve.nodes().front().along_W.head<2>().dot(
             graph[zone.track[1]].curve.nodes().front().along_W.head<2>()) > kAlike;
}

// The side of a zone from which a vehicle turns across the way of oncoming traffic that goes first; -1: neither.
std::int8_t WaitsSide(const TrafficMap& map, const lanes::Zone& zone) {
  if (zone.kind != lanes::ZoneKind::kCross) return -1;
  const int waits = 1 - zone.first;
  const std::uint32_t mine = zone.track[static_cast<std::size_t>(waits)],
                      theirs = zone.track[static_cast<std::size_t>(zone.first)];
  const int across = map.graph[mine].left_hand ? -1 : 1;
  if (map.plans[mine].turn != across || map.plans[theirs].turn == across) return -1;
  const double apart = map.graph[mine].curve.nodes().front().along_W.head<2>().dot(
      map.graph[theirs].curve.nodes().front().along_W.head<2>());
  return static_cast<std::int8_t>(apart < std::cos(lanes::kHeadOn_rad) ? waits : -1);
}

std::uint64_t KeyOf(const lanes::Graph& graph, std::uint32_t track) {
  const network::LaneKey& lane = graph[track].lane;
  std::uint64_t key = 0;
  for (const char letter : graph.network().roads()[lane.road].id())
    key = base::RandomBits({key, static_cast<unsigned char>(letter)});
  return base::RandomBits({key, lane.section, static_cast<std::uint64_t>(static_cast<std::int64_t>(lane.lane))});
}

std::vector<bool> ReachedOf(const lanes::Graph& graph) {
  std::vector<bool> reached(graph.tracks().size(), !graph.says_entries());
  std::vector<std::uint32_t> open;
  const auto reach = [&](std::uint32_t track) {
    if (!reached[track]) open.push_back(track);
    reached[track] = true;
  };
  for (std::uint32_t track = 0; track < reached.size(); ++track) {
    if (graph[track].entry) reach(track);
  }
  while (!open.empty()) {
    const lanes::Track& track = graph[open.back()];
    open.pop_back();
    for (const lanes::Link& link : track.next) reach(link.to);
    for (const auto& beside : {track.left, track.right}) {
      if (beside) reach(*beside);
    }
  }
  return reached;
}

}  // namespace

std::uint32_t TrafficMap::DrawEntry(std::uint64_t draw) const {
  std::size_t best = 0;
  std::uint64_t highest = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::uint64_t own = base::RandomBits({draw, entry_keys[i]});
    if (i == 0 || own > highest) best = i, highest = own;
  }
  return entries[best];
}

TrafficMap::TrafficMap(std::shared_ptr<const network::Network> of, const TrafficSettings& settings)
    : network(std::move(of)),
      graph(*network),
      zones(graph, LargestOf(settings), SwingsOf(graph, settings)),
      marks(graph),
      lane_ends(graph, marks),
      opposites(lanes::Opposites(graph)),
      no_overtaking(graph) {
  driver::SpeedPlanSettings speed = settings.speed;
  speed.tips_mps2 = TipsAt_mps2(settings);
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) plans.emplace_back(graph, track, speed);
  // A lane that is too short for a vehicle carries none.
  const double longest_m = LargestOf(settings).length_m;
  std::vector<bool> is_entry(graph.tracks().size());
  for (std::uint32_t track = 0; track < is_entry.size(); ++track)
    is_entry[track] = graph[track].entry && IsLongEnough(graph, track, longest_m);
  for (const bool clear : {true, false}) {
    for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
      const bool early = std::any_of(zones.Of(track).begin(), zones.Of(track).end(), [&](const lanes::ZoneSide& side) {
        return zones[side.zone].in_m[static_cast<std::size_t>(side.side)] < kEntryClear_m;
      });
      if (is_entry[track] && !(clear && early && !graph.says_entries())) entries.push_back(track);
    }
    if (!entries.empty()) break;
  }
  for (const std::uint32_t track : entries) entry_keys.push_back(KeyOf(graph, track));
  base::PreferHugePages(plans);
  for (const lanes::Zone& zone : zones.zones()) {
    zips.push_back(Zips(graph, zone));
    waits_side.push_back(WaitsSide(*this, zone));
  }
  enters.resize(graph.tracks().size());
  watched.resize(graph.tracks().size());
  for (std::uint32_t track = 0; track < enters.size(); ++track) {
    if (is_entry[track]) LetEnter(track);
  }
  reached = ReachedOf(graph);
}

void TrafficMap::LetEnter(std::uint32_t track) {
  enters[track] = watched[track] = true;
  for (const lanes::DivergeZone& part : zones.DivergeZonesOf(track)) watched[part.other] = true;
}

}  // namespace rodeira::traffic

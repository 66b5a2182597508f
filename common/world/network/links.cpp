// SPDX-License-Identifier: Apache-2.0
// Which lane goes on into which: within a road, from road to road, and through junctions.
#include <algorithm>

#include "common/world/network/network.hpp"

namespace rodeira::network {
namespace {

void AddOnce(std::vector<LaneEnd>& ends, const LaneEnd& end) {
  const auto at = std::lower_bound(ends.begin(), ends.end(), end);
  if (at == ends.end() || *at != end) ends.insert(at, end);
}

}  // namespace

std::uint32_t SectionMet(const RoadLink& link, const RoadSpec& other) {
  const auto count = static_cast<std::uint32_t>(other.sections.size());
  if (!link.s_m) return link.contact == End::kStart ? 0 : count - 1;
  std::uint32_t behind = 0;
  while (behind + 1 < count && other.sections[behind].s_m < *link.s_m) ++behind;
  return link.contact == End::kStart || behind == 0 ? behind : behind - 1;
}

// A link is known from both sides, whichever of them the file says it from.
void Network::Join(const LaneEnd& a, const LaneEnd& b) {
  Ends& of_a = ends_[Number(a.lane)];
  Ends& of_b = ends_[Number(b.lane)];
  AddOnce(a.end == End::kEnd ? of_a.at_end : of_a.at_start, b);
  AddOnce(b.end == End::kEnd ? of_b.at_end : of_b.at_start, a);
}

void Network::LinkEnd(const LaneKey& lane, const std::vector<int>& targets, bool at_end) {
  const RoadSpec& road = roads()[lane.road].spec();
  const End here = at_end ? End::kEnd : End::kStart;
  const bool inner = at_end ? lane.section + 1 < road.sections.size() : lane.section > 0;
  if (inner) {
    const LaneKey beside{lane.road, at_end ? lane.section + 1 : lane.section - 1, 0};
    for (const int id : targets) {
      const LaneKey target{beside.road, beside.section, id};
      if (id != 0 && Find(target) != nullptr) Join({lane, here}, {target, at_end ? End::kStart : End::kEnd});
    }
    return;
  }
  const std::optional<RoadLink>& link = at_end ? road.successor : road.predecessor;
  if (!link || link->junction) return;
  const auto other = FindRoad(link->id);
  if (!other) return;
  const std::uint32_t section = SectionMet(*link, roads()[*other].spec());
  for (const int id : targets) {
    const LaneKey target{*other, section, id};
    if (id != 0 && Find(target) != nullptr) Join({lane, here}, {target, link->contact});
  }
}

void Network::LinkJunctions() {
  for (const Junction& junction : junctions()) {
    for (const JunctionConnection& connection : junction.connections) {
      const auto incoming = FindRoad(connection.incoming_road);
      const auto connecting = FindRoad(connection.connecting_road);
      if (!incoming || !connecting) continue;
      const auto end_key = [&](std::uint32_t road, End end, int lane) {
        const auto last = static_cast<std::uint32_t>(roads()[road].spec().sections.size()) - 1;
        return LaneKey{road, end == End::kStart ? 0u : last, lane};
      };
      const RoadSpec& road = roads()[*incoming].spec();
      const RoadSpec& way = roads()[*connecting].spec();
      const std::optional<RoadLink>& back = connection.contact == End::kStart ? way.predecessor : way.successor;
      if (back && back->s_m && back->id == road.id) {  // in its middle
        for (const JunctionLaneLink& link : connection.lane_links) {
          const LaneKey from{*incoming, SectionMet(*back, road), link.from},
              to = end_key(*connecting, connection.contact, link.to);
          if (link.from != 0 && link.to != 0 && Find(from) != nullptr && Find(to) != nullptr)
            Join({from, back->contact}, {to, connection.contact});
        }
        continue;
      }
      // At which end the incoming road meets the junction.
      const auto meets = [&](const std::optional<RoadLink>& link) {
        return link && link->junction && link->id == junction.id;
      };
      std::vector<End> ends;
      if (meets(road.successor)) ends.push_back(End::kEnd);
      if (meets(road.predecessor)) ends.push_back(End::kStart);
      if (ends.size() == 2) {  // both: the one that the connecting road names
        if (back && !back->junction && back->id == road.id) ends = {back->contact};
      }
      for (const End end : ends) {
        for (const JunctionLaneLink& link : connection.lane_links) {
          const LaneKey from = end_key(*incoming, end, link.from),
                        to = end_key(*connecting, connection.contact, link.to);
          if (link.from != 0 && link.to != 0 && Find(from) != nullptr && Find(to) != nullptr)
            Join({from, end}, {to, connection.contact});
        }
      }
    }
  }
}

void Network::Link() {
  std::uint32_t count = 0;
  for (const Road& road : roads()) {
    auto& sections = first_lane_.emplace_back();
    for (const LaneSection& section : road.spec().sections) {
      sections.push_back(count);
      count += static_cast<std::uint32_t>(section.left.size() + section.right.size() + 1);
    }
  }
  ends_.resize(count);
  for (const LaneKey& key : Lanes()) {
    const Lane& lane = *Find(key);
    LinkEnd(key, lane.predecessors, false);
    LinkEnd(key, lane.successors, true);
  }
  LinkJunctions();
}

}  // namespace rodeira::network

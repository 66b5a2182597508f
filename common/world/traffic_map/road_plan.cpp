// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/road_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace rodeira::traffic_map {
namespace {

constexpr double kEnd_m = 5.0;  // of a lane, that becomes a connecting road; at most a third of it

class Planner {
 public:
  Planner(const LaneMap& map, Junctions kind) : map_(map), kind_(kind), group_(map.connections.size()) {}

  RoadPlan Plan() {
    Group();
    Cut();
    for (std::size_t lane = 0; lane < map_.lanes.size(); ++lane) plan_.roads.push_back(OwnRoad(lane));
    for (std::size_t i = 0; i < map_.connections.size(); ++i) Connect(i);
    return std::move(plan_);
  }

 private:
  // One lane alone leads to another one alone.
  bool IsLink(std::size_t connection) const {
    const MapConnection& c = map_.connections[connection];
    return map_.lanes[c.from].onward.size() == 1 && map_.lanes[c.to].arriving.size() == 1;
  }
  // A lane that lies in one junction with both its ends: its road is a connecting road.
  bool IsWay(std::size_t lane) const {
    const MapLane& at = map_.lanes[lane];
    return kind_ == Junctions::kCommon && at.arriving.size() == 1 && at.onward.size() == 1 && !IsLink(at.arriving[0]) &&
           !IsLink(at.onward[0]);
  }

  std::size_t GroupOf(std::size_t connection) {
    while (group_[connection] != connection) connection = group_[connection] = group_[group_[connection]];
    return connection;
  }
  // Connections share a junction that leave the same lane or arrive at the same lane, and so on; those of a way through
  // too.
  void Group() {
    std::iota(group_.begin(), group_.end(), std::size_t{0});
    const auto join = [&](std::size_t a, std::size_t b) {
      group_[std::max(GroupOf(a), GroupOf(b))] = std::min(GroupOf(a), GroupOf(b));
    };
    for (std::size_t lane = 0; lane < map_.lanes.size(); ++lane) {
      const MapLane& at = map_.lanes[lane];
      for (const auto* beside : {&at.onward, &at.arriving}) {
        for (const std::size_t other : *beside) join(beside->front(), other);
      }
      if (IsWay(lane)) join(at.arriving[0], at.onward[0]);
    }
    std::vector<std::size_t> numbers(group_.size(), kNoJunction);
    for (std::size_t i = 0; i < group_.size(); ++i) {
      std::size_t& number = numbers[GroupOf(i)];
      if (!IsLink(i) && number == kNoJunction) {
        number = plan_.junctions.size();
        plan_.junctions.emplace_back();
      }
    }
    for (std::size_t i = 0; i < group_.size(); ++i) junction_.push_back(IsLink(i) ? kNoJunction : numbers[GroupOf(i)]);
  }

  // Where no lane lies in a junction, an end of one has to.
  void Cut() {
    begin_m_.assign(map_.lanes.size(), 0.0);
    for (const MapLane& lane : map_.lanes) end_m_.push_back(lane.shape.length_m());
    if (kind_ == Junctions::kDirect) return;
    for (std::size_t i = 0; i < map_.connections.size(); ++i) {
      const MapConnection& c = map_.connections[i];
      if (IsLink(i) || IsWay(c.from) || IsWay(c.to)) continue;
      const bool head = map_.lanes[c.to].arriving.size() == 1;
      const double length = map_.lanes[head ? c.to : c.from].shape.length_m(), cut = std::min(kEnd_m, length / 3.0);
      if (head)
        begin_m_[c.to] = cut;
      else
        end_m_[c.from] = length - cut;
    }
  }

  PlannedLink LinkAt(std::size_t connection, bool behind) const {
    if (junction_[connection] != kNoJunction) return {junction_[connection], kNoRoad};
    return {kNoJunction, behind ? map_.connections[connection].to : map_.connections[connection].from};
  }

  // What of the lanes beside a way lies in its junction.
  void AddEnd(std::size_t lane, std::vector<RoadPart>& parts) const {
    const double length = map_.lanes[lane].shape.length_m();
    if (end_m_[lane] < length) parts.push_back({lane, end_m_[lane], length});
  }
  void AddBegin(std::size_t lane, std::vector<RoadPart>& parts) const {
    if (begin_m_[lane] > 0.0) parts.push_back({lane, 0.0, begin_m_[lane]});
  }

  PlannedRoad OwnRoad(std::size_t lane) {
    const MapLane& at = map_.lanes[lane];
    PlannedRoad road;
    road.id = at.id;
    road.name = fmt::format("lane {}", at.id);
    if (!IsWay(lane)) {
      road.parts = {{lane, begin_m_[lane], end_m_[lane]}};
      road.own = 0;
      if (!at.arriving.empty()) road.before = LinkAt(at.arriving[0], false);
      if (!at.onward.empty()) road.behind = LinkAt(at.onward[0], true);
      return road;
    }
    const std::size_t from = map_.connections[at.arriving[0]].from, to = map_.connections[at.onward[0]].to;
    AddEnd(from, road.parts);
    road.own = road.parts.size();
    road.parts.push_back({lane, 0.0, at.shape.length_m()});
    AddBegin(to, road.parts);
    road.junction = junction_[at.arriving[0]];
    road.before.road = from, road.behind.road = to;
    return road;
  }

  void Connect(std::size_t index) {
    const MapConnection& c = map_.connections[index];
    if (IsLink(index) || IsWay(c.from)) return;  // the way's own arriving connection has led to it
    auto& ways = plan_.junctions[junction_[index]];
    if (kind_ == Junctions::kDirect || IsWay(c.to)) {
      ways.push_back({c.from, c.to});
      return;
    }
    PlannedRoad road;
    road.id = 1 + std::max_element(plan_.roads.begin(), plan_.roads.end(), [](const auto& a, const auto& b) {
                    return a.id < b.id;
                  })->id;
    road.name = fmt::format("lane {} to {}", map_.lanes[c.from].id, map_.lanes[c.to].id);
    AddEnd(c.from, road.parts);
    AddBegin(c.to, road.parts);
    road.junction = junction_[index];
    road.before.road = c.from, road.behind.road = c.to;
    ways.push_back({c.from, plan_.roads.size()});
    plan_.roads.push_back(std::move(road));
  }

  const LaneMap& map_;
  Junctions kind_;
  RoadPlan plan_;
  std::vector<std::size_t> group_, junction_;  // by connection
  std::vector<double> begin_m_, end_m_;        // of each lane, what its own road has
};

}  // namespace

RoadPlan PlanRoads(const LaneMap& map, Junctions kind) { return Planner(map, kind).Plan(); }

}  // namespace rodeira::traffic_map

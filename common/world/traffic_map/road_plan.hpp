// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/world/traffic_map/lane_map.hpp"

namespace rodeira::traffic_map {

// How connections become junctions of OpenDRIVE, where they are no simple links.
enum class Junctions : std::uint8_t {
  kDirect,  // direct junctions (1.7): every lane is one road, as it is
  kCommon,  // common junctions with connecting roads, which other programs read: lanes that lie between two
            // connections, and otherwise an end of a lane
};

// A stretch of a lane, m along it.
struct RoadPart {
  std::size_t lane = 0;
  double from_m = 0.0, to_m = 0.0;

  double length_m() const { return to_m - from_m; }
};

inline constexpr std::size_t kNoJunction = static_cast<std::size_t>(-1);
inline constexpr std::size_t kNoRoad = static_cast<std::size_t>(-1);

// What lies at an end of a road: a junction, a road, or nothing.
struct PlannedLink {
  std::size_t junction = kNoJunction;
  std::size_t road = kNoRoad;
};

// A road: stretches of lanes, one after the other.
struct PlannedRoad {
  std::int32_t id = 0;  // a lane's own road has the lane's number
  std::string name;
  std::vector<RoadPart> parts;
  std::size_t own = kNoRoad;           // which of the parts is the lane with its number; that one's signals stand here
  std::size_t junction = kNoJunction;  // that it is a connecting road of
  PlannedLink before, behind;
};

// A way into a junction, and the connecting road, or the road that a direct one leads to.
struct PlannedWay {
  std::size_t from = 0, to = 0;  // roads
};

// The roads and junctions that a map becomes. The roads of the map's lanes come first, in the lanes' order.
struct RoadPlan {
  std::vector<PlannedRoad> roads;
  std::vector<std::vector<PlannedWay>> junctions;
};

// A pure function of the map; roads and junctions have indices in it.
RoadPlan PlanRoads(const LaneMap& map, Junctions kind);

}  // namespace rodeira::traffic_map

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/road_plan.hpp"

namespace rodeira::traffic_map {

// The map as OpenDRIVE 1.7, and how far it is from the map at most (measured at points between those that it was fitted
// to).
struct OpenDrive {
  std::string xml;
  std::size_t roads = 0;
  std::size_t junctions = 0;
  std::size_t pieces = 0;       // geometries of all roads
  double middle_error_m = 0.0;  // at the same distance along the lane
  double border_error_m = 0.0;
  double height_error_m = 0.0;
};

// Every lane is a road with the lane's number as its id: its reference line is the lane's middle as paramPoly3 by
// distance, lane -1 (of a map of left-hand traffic lane 1) reaches from border to border (laneOffset, width). Where a
// lane has one successor that has no other predecessor, the roads are linked; everywhere else a junction links them. Of
// common junctions the lanes that lie in them are connecting roads; where none does, the last or first 5 m of a lane
// are (a third of it at most), and its own road ends there. STOP is a signal of type 206, other signs are 205, 301 and
// 274, which is the lane's speed from there on too. The pieces are cut until
// every error is below 5 mm. Wrong input where a lane cannot be fitted so (a cusp).
base::Result<OpenDrive> ToOpenDrive(const LaneMap& map, const std::string& name,
                                    Junctions junctions = Junctions::kCommon);

}  // namespace rodeira::traffic_map

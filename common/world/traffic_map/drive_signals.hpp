// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <pugixml.hpp>

#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/road_plan.hpp"

namespace rodeira::traffic_map {

// Attributes as OpenDRIVE's files have them: numbers that read back to the same bits.
void Set(pugi::xml_node node, const char* name, double value);
void Set(pugi::xml_node node, const char* name, std::string_view value);

// The signs along a lane by their place; none that says what a STOP flag says already.
std::vector<MapSign> SignsOf(const LaneMap& map, std::size_t lane);
// Signs, lights, and what is painted where one stops or gives way: of the part of the road that is a lane's own.
void WriteSignals(const LaneMap& map, const PlannedRoad& plan, pugi::xml_node road);
// The light's times, which OpenDRIVE has no place for, stand in the data of users.
void WriteController(const LaneMap& map, std::size_t light, pugi::xml_node root);

}  // namespace rodeira::traffic_map

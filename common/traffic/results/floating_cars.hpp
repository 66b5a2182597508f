// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// Floating car data as SUMO's tools read it: <fcd-export>, a <timestep> a moment, a <vehicle> a car with x, y (m),
// angle (degrees from north, clockwise), speed (m/s), pos (of the front on its lane, m), lane ("road_index", from 0 at
// the right edge), slope (degrees). x and y are those of the front bumper's middle, as SUMO has them. Another trip is
// another vehicle ("7.2").
std::string SumoLaneOf(const lanes::Graph& graph, std::uint32_t track);  // "road_index", as text of an XML file
std::string FloatingCarsBegin();
std::string FloatingCarsAt(double time_s, const TrafficModel& model);
std::string FloatingCarsEnd();

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/world/lanes/graph.hpp"

// Floating car data as SUMO's tools read it: <fcd-export>, a <timestep> a moment, a <vehicle> a car, a <person> a
// pedestrian.
namespace rodeira::lanes {

// One vehicle or pedestrian at one moment.
struct FloatingCar {
  std::string id;
  std::string_view kind;                    // "car"; empty: a pedestrian
  double front_x_m = 0.0, front_y_m = 0.0;  // of the front bumper's middle, as SUMO has it
  double heading_rad = 0.0;                 // from east, counter-clockwise
  double pitch_up_rad = 0.0;                // positive nose up
  double speed_mps = 0.0;
  std::string lane{};         // SumoLaneOf; empty: in none
  double lane_front_m = 0.0;  // of the front on that lane
};

// The name of a track's lane as SUMO names lanes, "road_index": the index counts from 0 at the right edge of the
// direction. It is text of an XML file.
std::string SumoLaneOf(const Graph& graph, std::uint32_t track);

inline constexpr std::string_view kFloatingCarsBegin = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fcd-export>\n";
inline constexpr std::string_view kFloatingCarsEnd = "</fcd-export>\n";
inline constexpr std::string_view kTimestepEnd = "    </timestep>\n";
// Append to `text`: the opening tag of a moment, `time_s` after the run's beginning, and one car or pedestrian.
void AppendTimestepBegin(double time_s, std::string& text);
void AppendFloatingCar(const FloatingCar& car, std::string& text);

}  // namespace rodeira::lanes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/analysis/measures/encounter.hpp"
#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// The vehicle ahead of or behind another one along its lane.
struct Neighbour {
  std::vector<double> id;     // of the agent; of a driven vehicle: minus its number, from 1
  std::vector<double> gap_m;  // from bumper to bumper along the lane; negative where they overlap
  std::vector<double> speed_mps;
  std::vector<double> length_m;
};

// The motion of one road user over a recording, at a uniform rate from time 0 on. A missing value is NaN. Lateral
// quantities are positive to the driver's left, along the road or against it.
struct Drive {
  double rate_hz = 100.0;
  std::string subject;  // name of the vehicle, or "agent 7"
  std::string notes;    // what could not be found out, in sentences; empty: nothing

  // Of the reference point B, midway between the axles.
  std::vector<double> x_m, y_m, z_m;
  std::vector<double> heading_rad;  // from east, counter-clockwise
  std::vector<double> speed_mps;    // along the heading; negative in reverse
  std::vector<double> yaw_radps;
  std::vector<double> throttle, brake;     // 0 to 1; of the driven vehicle only, as the next two
  std::vector<double> steering_wheel_deg;  // positive to the left
  std::vector<double> indicator;           // 0 none, 1 left, 2 right, 3 both
  std::vector<double> fuel_used_kg;        // since the start; of the driven vehicle only
  double front_m = kMissing, length_m = kMissing, width_m = kMissing;  // of the footprint; B to the front bumper

  // In the world. Beside the road, and in junctions, there is no lane.
  std::vector<double> road, lane;  // index of the road in the world's file; id of the lane
  std::vector<double> s_m, t_m;    // station, and offset from the road's reference line
  std::vector<double> lane_width_m;
  std::vector<double> lane_position_m;    // of B from the lane's middle
  std::vector<double> heading_error_rad;  // to the lane's middle
  std::vector<double> lane_curvature_1pm;
  std::vector<double> left_line_m, right_line_m;  // from the body's edge to the lane's line; negative beyond it
  std::vector<double> speed_limit_mps;
  std::vector<double> junction;  // 1 within a junction, otherwise 0
  // From the front to the begin of the next junction, and to the line of the next light; negative beyond it, until B is
  // there. The light's colour: 0 red, 1 red and amber, 2 green, 3 amber.
  std::vector<double> junction_ahead_m, light_ahead_m, light_ahead;
  std::vector<std::int32_t> episode;  // numbers the times in one lane (lane_position.hpp)
  std::vector<std::int8_t> crossing;  // lane changes (lane_change.hpp)
  Neighbour leader, follower;
  Neighbour left_leader, left_follower, right_leader, right_follower;  // in the next lanes of the same direction

  // With vehicles that cross or join the path, by time; nothing: the paths of others are not known.
  std::optional<std::vector<Encounter>> encounters;

  std::size_t size() const { return x_m.size(); }
};

// The columns of a drive that are numbers, by name with unit.
struct DriveColumn {
  const char* name;
  const std::vector<double>& (*of)(const Drive& drive);
};
// In the order of a table's columns.
std::span<const DriveColumn> DriveColumns();
// The column of that name; null where there is none.
std::vector<double>* FindColumn(Drive& drive, std::string_view name);
// Adds missing samples to every column up to that size.
void GrowColumns(Drive& drive, std::size_t size);

// The samples [from, to) of a column.
inline Series Part(const std::vector<double>& column, std::size_t from, std::size_t to) {
  return Series(column).subspan(from, to - from);
}

}  // namespace rodeira::measures

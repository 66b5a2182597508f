// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// The table of the lights: a row a head and lane at the beginning and whenever its colour changes. A head is a signal
// of the network that a lane's traffic obeys; x, y and heading are those of its line, in the middle of the lane.
class SignalTable {
 public:
  explicit SignalTable(const lanes::Graph& graph);

  // The first line of the table.
  static const char* Header() { return "time_s,head,colour,road,lane,x_m,y_m,heading_rad,width_m\n"; }
  // Rows for what has changed since the last call.
  std::string At(double time_s, const TrafficModel& model);

 private:
  struct Head {
    std::uint32_t controller = 0;
    std::optional<network::LightColour> shown;
    std::string head, place;  // the cells before and after the colour
  };
  std::vector<Head> heads_;
};

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// Where the cars of one lane are over time: their ways as lines, coloured by speed. Waves of stopped traffic show as
// bands that run against the driving.
class TrajectoryDiagram {
 public:
  // The track must be one of the model's.
  explicit TrajectoryDiagram(std::uint32_t track) : track_(track) {}

  // After a step; time_s ascends.
  void Add(double time_s, const TrafficModel& model);
  // A whole SVG document of what has been added so far.
  std::string ToSvg(const lanes::Graph& graph, const std::string& title) const;

 private:
  struct Point {
    double time_s, d_m, speed_mps;
  };

  std::uint32_t track_;
  double last_s_ = 0.0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Point>> ways_;  // by vehicle and trip
};

}  // namespace rodeira::traffic

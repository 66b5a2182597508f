// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/config.hpp"

namespace rodeira::traffic {

// How many come to one crossing: the one of the road that is nearest to a station. `place` is file and line.
struct CrossingFlow {
  std::string road;
  double s_m = 0.0;
  double per_h = 0.0;
  std::string place;
};

// People on foot who cross where crossings are.
struct PedestrianSettings {
  double per_h = 0.0;  // that come to each crossing, from both sides together
  double slowest_mps = 1.2, fastest_mps = 1.5;
  std::vector<CrossingFlow> at;  // crossings with another number
  std::string place;             // file and line, for what is wrong with them
};

// Reads `per_hour`, `slowest_mps`, `fastest_mps` and `at`. Problems stay in the file's collection.
PedestrianSettings ReadPedestrians(const config::Map& map);

}  // namespace rodeira::traffic

#pragma once

#include <cstdint>
#include <string>

namespace rodeira::front {

// `rodeira traffic run MAP --vehicles N --for S [--csv DIR]`
struct TrafficOptions {
  bool asked = false;
  std::string map;  // a world file, .xodr or .motors
  std::uint32_t vehicles = 50;
  double duration_s = 60.0;
  double step_s = 0.01;
  std::uint64_t seed = 1;
  std::string csv;  // folder; empty: no tables
  bool quiet = false;
};

// The traffic model alone on a map's roads: no network, no other node. Status 2 where the map or an option is wrong.
int TrafficRun(const TrafficOptions& options);

}  // namespace rodeira::front

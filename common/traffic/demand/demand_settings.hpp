// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/config/config.hpp"
#include "common/traffic/demand/vehicle_mix.hpp"

namespace rodeira::traffic {

enum class Arrivals {
  kPoisson,  // gaps exponentially distributed
  kEven,     // equal gaps
  kUniform,  // gaps uniformly distributed between two times, as MOTORS has it
};

// Vehicles that enter on a lane. `place`: file and line, for messages.
struct FlowSettings {
  std::string lane;   // ROAD:LANE; empty: a random entry of the network
  std::string route;  // its name; empty: random turns, weighted by turning shares
  Arrivals arrivals = Arrivals::kPoisson;
  std::vector<double> per_h;                   // vehicles per hour, by hour from from_s; the last persists
  double least_gap_s = 3.0, most_gap_s = 8.0;  // of kUniform
  double from_s = 0.0, to_s = 1e9;
  std::optional<VehicleMix> mix;
  std::string place;
};

// Roads (ID) or lanes (ROAD:LANE) that are passed one after the other.
struct RouteSettings {
  std::string name;
  std::vector<std::string> ways;
  std::string place;
};

// How many of those on a lane without a route go on into which road (ID) or lane (ROAD:LANE).
struct TurnSettings {
  std::string lane;
  std::vector<std::pair<std::string, double>> shares;  // weights of any size
  std::string place;
};

// What a traffic file says of which vehicles come where.
struct DemandSettings {
  std::vector<FlowSettings> flows;
  std::vector<RouteSettings> routes;
  std::vector<TurnSettings> turns;
};

// Reads `flows`, `routes` and `turns`. Problems stay in the file's collection.
DemandSettings ReadDemand(const config::Map& map);

}  // namespace rodeira::traffic

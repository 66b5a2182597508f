// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// A <timestep> of floating car data (common/world/lanes/floating_car.hpp) with all vehicles of the traffic. Another
// trip is another vehicle ("7.2").
std::string FloatingCarsAt(double time_s, const TrafficModel& model);

}  // namespace rodeira::traffic

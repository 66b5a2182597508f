// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// What a node outside asks of the traffic, as in traffic_requests.idl.
struct TrafficRequest {
  std::string name;
  std::uint32_t agent = 0;
  double speed_mps = 0.0;
  std::string lane;
  double station_m = 0.0;
  std::string choice;
  std::vector<std::string> roads;
  std::string light;
  double duration_s = 0.0;
};

// What became of a request.
struct TrafficAnswer {
  std::optional<base::Error> refusal;  // nothing has changed then
  std::uint32_t agent = 0;             // of the request, or the one that has been added
  std::string lane;                    // where the agent is asked for: ROAD:LANE at its middle …
  double station_m = 0.0;              // … s of the road there …
  std::vector<std::string> roads;      // … and RoadsAhead
};

// Carries out a request between two steps of the model.
TrafficAnswer Answer(TrafficModel& model, const TrafficRequest& request);

}  // namespace rodeira::traffic

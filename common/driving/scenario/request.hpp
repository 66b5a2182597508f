// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/driving/scenario/event.hpp"

namespace rodeira::scenario {

inline constexpr std::string_view kPlaceRequest =
    "place";  // argument: the vehicle, and the height near which the ground is meant; value: degrees
inline constexpr std::string_view kWeatherRequest = "weather";  // argument: its name; value: seconds

// A request of an operator (idl/operator_input.idl).
struct Request {
  std::string name, argument;
  double x_m = 0.0, y_m = 0.0;
  double value = 0.0;
};

// The requests for a car at a place, facing a heading (0 is east, counter-clockwise), and for a weather that is reached
// within `over_s` seconds.
Request PlaceRequest(const PlaceChoice& place, double heading_deg);
// The weather's name is not looked at.
Request WeatherRequest(std::string_view weather, double over_s);

// The event that it becomes. Wrong input where it cannot be obeyed.
base::Result<Event> EventOf(const Request& request);

}  // namespace rodeira::scenario

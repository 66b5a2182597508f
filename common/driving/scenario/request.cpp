// SPDX-License-Identifier: Apache-2.0
#include "common/driving/scenario/request.hpp"

#include <fmt/format.h>

namespace rodeira::scenario {
namespace {

base::Result<Event> PlaceEvent(const Request& request) {
  const std::size_t space = request.argument.find(' ');
  const std::string vehicle = request.argument.substr(0, space),
                    height = space == std::string::npos ? std::string() : request.argument.substr(space);
  const auto place = ParsePlace(fmt::format("{} {} {}{}", vehicle, request.x_m, request.y_m, height));
  if (!place) return place.error();
  return Event{std::string(kVehiclePlace), PlaceText(place.value()), request.value};
}

}  // namespace

Request PlaceRequest(const PlaceChoice& place, double heading_deg) {
  return {std::string(kPlaceRequest), place.z_m ? fmt::format("{} {}", place.vehicle, *place.z_m) : place.vehicle,
          place.x_m, place.y_m, heading_deg};
}

Request WeatherRequest(std::string_view weather, double over_s) {
  return {std::string(kWeatherRequest), std::string(weather), 0.0, 0.0, over_s};
}

base::Result<Event> EventOf(const Request& request) {
  base::Result<Event> event = base::WrongInput(
      "scenario.unknown_request", fmt::format("'{}' was asked for; {} or {} was expected", request.name.substr(0, 40),
                                              kPlaceRequest, kWeatherRequest));
  if (request.name == kPlaceRequest) event = PlaceEvent(request);
  if (request.name == kWeatherRequest) event = Event{std::string(kWeatherChange), request.argument, request.value};
  if (!event) return event.error();
  if (const base::Status sound = CheckEvent(event.value()); !sound) return sound.error();
  return event;
}

}  // namespace rodeira::scenario

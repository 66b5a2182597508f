// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/core/base/result.hpp"

// The vocabulary of scenario events, for publishers and for the nodes that obey.
namespace rodeira::scenario {

inline constexpr std::string_view kMark = "mark";                         // a text in the recording; no node obeys
inline constexpr std::string_view kTrafficBrake = "traffic.brake";        // at a deceleration down to rest, and stay
inline constexpr std::string_view kTrafficSpeed = "traffic.speed";        // drive no faster than this
inline constexpr std::string_view kTrafficRelease = "traffic.release";    // forget all that
inline constexpr std::string_view kTrafficOvertake = "traffic.overtake";  // the vehicle ahead, as soon as it is safe
inline constexpr std::string_view kTrafficChangeLane =
    "traffic.change_lane";                                            // to the lane beside, as soon as it is safe
inline constexpr std::string_view kTrafficAppear = "traffic.appear";  // a vehicle comes onto the middle of a lane
inline constexpr std::string_view kTrafficPedestrian = "traffic.pedestrian";  // a pedestrian comes to a crossing
inline constexpr std::string_view kVehiclePlace = "vehicle.place";  // a driver's car stands elsewhere: INI there
inline constexpr std::string_view kVehicleGust = "vehicle.gust";    // wind across a driver's car, for a while
inline constexpr std::string_view kVehicleTyrePressure = "vehicle.tyre_pressure";  // a tyre loses or gains pressure
inline constexpr std::string_view kWeatherChange = "weather";  // becomes one that has a name, within so many seconds

// As on the wire (idl/scenario.idl).
struct Event {
  std::string name;
  std::string argument;
  double value = 0.0;
};

enum class ArgumentKind { kText, kAgent, kAgentOnLane, kPlace, kGust, kTyre, kWeather, kCrossing };
enum class ValueKind { kNumber, kSide };  // a side: `left` is 1, `right` -1

// What a kind of event is told, and under which keys a person writes it.
struct EventKind {
  std::string_view name;
  std::string_view argument_key;
  ArgumentKind argument = ArgumentKind::kText;
  std::string_view value_key;    // with its unit; empty: it has none
  double low = 0.0, high = 0.0;  // of the value
  ValueKind value = ValueKind::kNumber;
};
// All kinds of events that nodes obey or recordings hold.
std::span<const EventKind> EventKinds();
// Null where there is no such kind.
const EventKind* FindEventKind(std::string_view name);

// Which agents of the traffic are meant: a number, "all", or "ahead": the next one in front of the driver's car in its
// lane at the moment at which the event acts. With a place ("12 at main 350") when they pass it from then on: the one,
// each one, the one that was ahead, or "next": the first that passes.
struct AgentChoice {
  enum class Kind { kOne, kAll, kAhead, kNext };
  // The place that agents pass.
  struct At {
    std::string road;
    double s_m = 0.0;  // of the road's axis
  };
  Kind kind = Kind::kOne;
  std::uint32_t id = 0;
  std::optional<At> at;  // kNext: always
};
// This and the functions below read an event's argument; Wrong input, with what was expected, where it is none.
base::Result<AgentChoice> ParseAgent(std::string_view text);
// Of one agent where on which lane: "20 at main:-1 350"; the road of `at` is then ROAD:LANE.
base::Result<AgentChoice> ParseAgentOnLane(std::string_view text);
// The argument that ParseAgent reads as this agent at this place.
std::string AgentText(std::string_view agent, const AgentChoice::At& at);

// Which car, and where: "ego 12.5 -3.25", metres; with a third number the height near which the ground is meant.
struct PlaceChoice {
  std::string vehicle;
  double x_m = 0.0, y_m = 0.0;
  std::optional<double> z_m;
};
// Any finite numbers; whether the vehicle exists is not looked at.
base::Result<PlaceChoice> ParsePlace(std::string_view text);
// The argument that ParsePlace reads as this place.
std::string PlaceText(const PlaceChoice& place);

// Wind that meets a car from a side, and for how long: "ego 90 1.5" is from the north (0 is east), 1.5 s.
struct GustChoice {
  std::string vehicle;
  double from_deg = 0.0;
  double for_s = 0.0;  // over 0
};
// Degrees from -360 to 360, seconds over 0 to 3600.
base::Result<GustChoice> ParseGust(std::string_view text);

// A tyre of a car, and in how many seconds its pressure changes: "ego front_left 0.5".
struct TyreChoice {
  std::string vehicle;
  std::size_t wheel = 0;  // front left, front right, rear left, rear right
  double over_s = 0.0;
};
// Seconds from 0 to 3600.
base::Result<TyreChoice> ParseTyre(std::string_view text);

// The crossing of a road nearest to a station, and from which side of the road a pedestrian comes: "main 120", "main
// 120 left"; right where no side is said.
struct CrossingChoice {
  std::string road;
  double s_m = 0.0;
  bool from_left = false;
};
// Whether the road exists is not looked at.
base::Result<CrossingChoice> ParseCrossing(std::string_view text);

// Wrong input with what was expected where an event's name, argument or value cannot be obeyed.
base::Status CheckEvent(const Event& event);

}  // namespace rodeira::scenario

// SPDX-License-Identifier: Apache-2.0
#include "common/driving/scenario/event.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "common/core/base/suggest.hpp"
#include "common/world/weather/named_weather.hpp"

namespace rodeira::scenario {
namespace {

constexpr std::uint32_t kMaxAgents = 100'000;

constexpr std::array kKinds = std::to_array<EventKind>({
    {kMark, "text", ArgumentKind::kText, "", 0.0, 0.0},
    {kTrafficBrake, "agent", ArgumentKind::kAgent, "deceleration_mps2", 0.1, 10.0},
    {kTrafficSpeed, "agent", ArgumentKind::kAgent, "speed_mps", 0.5, 100.0},
    {kTrafficRelease, "agent", ArgumentKind::kAgent, "", 0.0, 0.0},
    {kTrafficOvertake, "agent", ArgumentKind::kAgent, "", 0.0, 0.0},
    {kTrafficChangeLane, "agent", ArgumentKind::kAgent, "side", -1.0, 1.0, ValueKind::kSide},
    {kTrafficAppear, "agent", ArgumentKind::kAgentOnLane, "speed_mps", 0.0, 100.0},
    {kTrafficPedestrian, "crossing", ArgumentKind::kCrossing, "", 0.0, 0.0},
    {kVehiclePlace, "place", ArgumentKind::kPlace, "heading_deg", -360.0, 360.0},
    {kVehicleGust, "gust", ArgumentKind::kGust, "speed_mps", 0.0, 60.0},
    {kVehicleTyrePressure, "tyre", ArgumentKind::kTyre, "pressure_share", 0.0, 1.5},
    {kWeatherChange, "becomes", ArgumentKind::kWeather, "over_s", 0.0, 3600.0},
});

// Words between single spaces.
std::vector<std::string_view> WordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0;;) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    if (end == text.size()) return words;
    begin = end + 1;
  }
}

std::optional<double> NumberIn(std::string_view word) {
  double value = 0.0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::span<const EventKind> EventKinds() { return kKinds; }

const EventKind* FindEventKind(std::string_view name) {
  const auto found =
      std::find_if(kKinds.begin(), kKinds.end(), [name](const EventKind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : &*found;
}

base::Result<AgentChoice> ParseAgent(std::string_view text) {
  AgentChoice choice;
  constexpr std::string_view kAt = " at ";
  const std::size_t at = text.find(kAt);
  const std::string_view selector = text.substr(0, at);
  if (at != std::string_view::npos) {
    const std::string_view place = text.substr(at + kAt.size());
    const std::size_t space = place.rfind(' ');
    const auto station =
        space == std::string_view::npos || space == 0 ? std::nullopt : NumberIn(place.substr(space + 1));
    if (!station || *station < 0.0) {
      return base::WrongInput(
          "scenario.wrong_text",
          fmt::format("'{}' is no place; a road and metres along it were expected, as in 'next at main 350'",
                      place.substr(0, 60)));
    }
    choice.at = AgentChoice::At{std::string(place.substr(0, space)), *station};
  }
  if (selector == "next" && !choice.at)
    return base::WrongInput("scenario.wrong_text",
                            "'next' needs a place; the next agent that comes there is taken, as in 'next at main 350'");
  if (selector == "all" || selector == "ahead" || selector == "next") {
    choice.kind = selector == "all"     ? AgentChoice::Kind::kAll
                  : selector == "ahead" ? AgentChoice::Kind::kAhead
                                        : AgentChoice::Kind::kNext;
    return choice;
  }
  const auto [end, problem] = std::from_chars(selector.data(), selector.data() + selector.size(), choice.id);
  if (problem != std::errc{} || end != selector.data() + selector.size() || choice.id >= kMaxAgents) {
    return base::WrongInput("scenario.wrong_text", "'" + std::string(selector.substr(0, 40)) +
                                                       "' is no agent; its number, all or ahead was expected");
  }
  return choice;
}

base::Result<AgentChoice> ParseAgentOnLane(std::string_view text) {
  auto choice = ParseAgent(text);
  if (!choice) return choice.error();
  const std::string_view lane = choice.value().at ? std::string_view(choice.value().at->road) : std::string_view();
  const std::size_t colon = lane.rfind(':');
  if (choice.value().kind == AgentChoice::Kind::kOne && colon != std::string_view::npos && colon > 0 &&
      NumberIn(lane.substr(colon + 1)))
    return choice;
  return base::WrongInput(
      "scenario.wrong_text",
      fmt::format("'{}' is no agent on a lane; its number, ROAD:LANE and metres along the road were expected, as in "
                  "'20 at main:-1 350'",
                  text.substr(0, 60)));
}

std::string AgentText(std::string_view agent, const AgentChoice::At& at) {
  return fmt::format("{} at {} {}", agent, at.road, at.s_m);
}

base::Result<PlaceChoice> ParsePlace(std::string_view text) {
  const auto words = WordsOf(text);
  PlaceChoice place;
  if ((words.size() == 3 || words.size() == 4) && !words[0].empty()) {
    const auto x = NumberIn(words[1]), y = NumberIn(words[2]);
    if (words.size() == 4) place.z_m = NumberIn(words[3]);
    if (x && y && place.z_m.has_value() == (words.size() == 4)) {
      place.vehicle = words[0];
      place.x_m = *x, place.y_m = *y;
      return place;
    }
  }
  return base::WrongInput(
      "scenario.wrong_text",
      fmt::format("'{}' is no place; the name of a vehicle node and metres to the east and north were expected, as in "
                  "'ego 12.5 -3.25'",
                  text.substr(0, 60)));
}

std::string PlaceText(const PlaceChoice& place) {
  const std::string plan = fmt::format("{} {} {}", place.vehicle, place.x_m, place.y_m);
  return place.z_m ? fmt::format("{} {}", plan, *place.z_m) : plan;
}

base::Result<GustChoice> ParseGust(std::string_view text) {
  const auto words = WordsOf(text);
  if (words.size() == 3 && !words[0].empty()) {
    const auto from = NumberIn(words[1]), seconds = NumberIn(words[2]);
    if (from && seconds && std::fabs(*from) <= 360.0 && *seconds > 0.0 && *seconds <= 3600.0)
      return GustChoice{std::string(words[0]), *from, *seconds};
  }
  return base::WrongInput(
      "scenario.wrong_text",
      fmt::format("'{}' is no gust; the name of a vehicle node, degrees (-360 to 360, 0 is east, 90 north) from where "
                  "it blows, and seconds (over 0, to 3600) were expected, as in 'ego 90 1.5'",
                  text.substr(0, 60)));
}

base::Result<TyreChoice> ParseTyre(std::string_view text) {
  static const std::vector<std::string> kTyres{"front_left", "front_right", "rear_left", "rear_right"};
  const auto words = WordsOf(text);
  if (words.size() == 3 && !words[0].empty()) {
    const auto wheel = std::find(kTyres.begin(), kTyres.end(), words[1]);
    const auto seconds = NumberIn(words[2]);
    if (wheel != kTyres.end() && seconds && *seconds >= 0.0 && *seconds <= 3600.0)
      return TyreChoice{std::string(words[0]), static_cast<std::size_t>(wheel - kTyres.begin()), *seconds};
  }
  return base::WrongInput(
      "scenario.wrong_text",
      fmt::format("'{}' is no tyre; the name of a vehicle node, front_left, front_right, rear_left or rear_right, and "
                  "seconds (0 to 3600) were expected, as in 'ego front_left 0.5'{}",
                  text.substr(0, 60), words.size() < 2 ? "" : base::DidYouMean(std::string(words[1]), kTyres)));
}

base::Result<CrossingChoice> ParseCrossing(std::string_view text) {
  auto words = WordsOf(text);
  CrossingChoice crossing;
  if (words.back() == "left" || words.back() == "right") {
    crossing.from_left = words.back() == "left";
    words.pop_back();
  }
  const auto station = words.size() < 2 ? std::nullopt : NumberIn(words.back());
  if (!station || words.front().empty()) {
    return base::WrongInput(
        "scenario.wrong_text",
        fmt::format(
            "'{}' is no crossing; a road, metres along it, and 'left' or 'right' were expected, as in 'main 120 left'",
            text.substr(0, 60)));
  }
  crossing.s_m = *station;
  crossing.road = std::string(text.substr(0, static_cast<std::size_t>(words.back().data() - text.data()) - 1));
  return crossing;
}

base::Status CheckEvent(const Event& event) {
  const EventKind* kind = FindEventKind(event.name);
  if (kind == nullptr) {
    std::vector<std::string> names;
    for (const EventKind& known : kKinds) names.emplace_back(known.name);
    return base::WrongInput("scenario.unknown_event",
                            fmt::format("there is no event '{}'{}", event.name, base::DidYouMean(event.name, names)));
  }
  if (kind->argument == ArgumentKind::kAgent) {
    if (const auto agent = ParseAgent(event.argument); !agent) return agent.error();
  } else if (kind->argument == ArgumentKind::kAgentOnLane) {
    if (const auto agent = ParseAgentOnLane(event.argument); !agent) return agent.error();
  } else if (kind->argument == ArgumentKind::kCrossing) {
    if (const auto crossing = ParseCrossing(event.argument); !crossing) return crossing.error();
  } else if (kind->argument == ArgumentKind::kPlace) {
    if (const auto place = ParsePlace(event.argument); !place) return place.error();
  } else if (kind->argument == ArgumentKind::kGust) {
    if (const auto gust = ParseGust(event.argument); !gust) return gust.error();
  } else if (kind->argument == ArgumentKind::kTyre) {
    if (const auto tyre = ParseTyre(event.argument); !tyre) return tyre.error();
  } else if (kind->argument == ArgumentKind::kWeather) {
    if (const auto named = weather::FindWeather(event.argument); !named) return named.error();
  }
  if (kind->value == ValueKind::kSide && event.value != 1.0 && event.value != -1.0) {
    return base::WrongInput("scenario.wrong_value",
                            fmt::format("'{}' of '{}' is {}; 1 (left) or -1 (right) was expected", kind->value_key,
                                        event.name, event.value));
  }
  if (kind->value_key.empty() || (event.value >= kind->low && event.value <= kind->high)) return {};
  return base::WrongInput("scenario.wrong_value",
                          fmt::format("'{}' of '{}' is {}; {} to {} was expected", kind->value_key, event.name,
                                      event.value, kind->low, kind->high));
}

}  // namespace rodeira::scenario

// SPDX-License-Identifier: Apache-2.0
#include "common/driving/scenario/scenario_schema.hpp"

#include <algorithm>

#include "common/driving/scenario/event.hpp"
#include "common/world/weather/weather_schema.hpp"

namespace rodeira::scenario {
namespace {

using config::ComputedTextKey;
using config::RequiredNumberKey;

// The range of a value that several kinds of events have.
config::Range RangeOf(std::string_view value_key) {
  config::Range range{0.0, 0.0};
  bool is_first = true;
  for (const EventKind& kind : EventKinds()) {
    if (kind.value_key != value_key) continue;
    range = is_first ? config::Range{kind.low, kind.high}
                     : config::Range{std::min(range.low, kind.low), std::max(range.high, kind.high)};
    is_first = false;
  }
  return range;
}

config::Key ValueKey(std::string name, std::string event, std::string meaning) {
  const config::Range range = RangeOf(name);
  return config::ComputedNumberKey(std::move(name), range, "with " + std::move(event), std::move(meaning));
}

std::vector<config::Key> EventKeys() {
  std::vector<std::string> names;
  for (const EventKind& kind : EventKinds()) names.emplace_back(kind.name);
  return {
      config::ComputedNumberKey("at_s", {0.0, 1e6}, "or `when`",
                                "A multiple of the node's period; times do not descend."),
      config::MappingKey("when",
                         {config::ComputedTextKey("road", "the only one", "main", "Road of the station."),
                          RequiredNumberKey("passes_m", {0.0, 1e6}, "Station; the event is when the car passes it.")},
                         "Condition instead of `at_s`."),
      config::Summarised("one of those above",
                         config::Required(config::WordKey("name", names, names.front(), "Kind of event."))),
      ComputedTextKey("text", "with mark", "begin", "Text for the recording."),
      ComputedTextKey("agent", "with traffic.*", "12", "Number of an agent, `all`, `ahead` or `next`."),
      config::MappingKey("at",
                         {ComputedTextKey("road", "with an event for an agent", "main", "Road."),
                          ComputedTextKey("lane", "with traffic.appear", "main:-1", "ROAD:LANE."),
                          RequiredNumberKey("s_m", {0.0, 1e7}, "Station.")},
                         "Place of the event."),
      ComputedTextKey("crossing", "with traffic.pedestrian", "main 120", "Road, station and `left` or nothing."),
      ComputedTextKey("place", "with vehicle.place", "ego 12.5 -3.25",
                      "Vehicle, metres east and north, height if a level is meant."),
      ComputedTextKey("gust", "with vehicle.gust", "ego 90 1.5",
                      "Vehicle, from where in degrees (0 east, 90 north), seconds."),
      ComputedTextKey("tyre", "with vehicle.tyre_pressure", "ego front_left 0.5", "Vehicle, tyre, seconds."),
      ComputedTextKey("becomes", "with weather", "rain", "`fine`, `overcast`, `rain`, `fog`, `dusk` or `night`."),
      ValueKey("deceleration_mps2", "traffic.brake", "Deceleration."),
      ValueKey("speed_mps", "traffic.speed, .appear, vehicle.gust", "Speed; of a gust to 60."),
      config::WithDefaultNote("with traffic.change_lane",
                              config::OptionalWordKey("side", {"left", "right"}, "Where to.")),
      ValueKey("heading_deg", "vehicle.place", "Direction, from east to the left."),
      ValueKey("pressure_share", "vehicle.tyre_pressure", "Of the pressure at the start; 0 is flat."),
      ValueKey("over_s", "weather", "How long the change takes."),
  };
}

config::Schema MakeScenarioSchema() {
  config::Schema schema{"scenario", "scenario/1", "Events and weather, for a node of kind 'scenario'.", {}};
  schema.keys = config::FileKeys("scenario/1",
                                 {config::TextKey("name", "", "Name, for the reader."),
                                  config::ListKey("weather", weather::WeatherChangeKeys(), "Changes of the weather."),
                                  config::ListKey("events", EventKeys(), "Events; required without `weather`.")});
  return schema;
}

}  // namespace

const config::Schema& ScenarioSchema() {
  static const config::Schema schema = MakeScenarioSchema();
  return schema;
}

}  // namespace rodeira::scenario

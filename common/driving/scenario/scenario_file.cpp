// SPDX-License-Identifier: Apache-2.0
#include "common/driving/scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/config/declared.hpp"
#include "common/driving/scenario/scenario_schema.hpp"

namespace rodeira::scenario {
namespace {

constexpr double kLongest_s = 1e6;

// Seconds of so many steps, without a rest of the arithmetic.
std::string SecondsText(std::int64_t steps, const Timing& timing) {
  return fmt::format("{:.9g}", static_cast<double>(steps * timing.base_step_ns) * 1e-9);
}

std::optional<std::int64_t> ReadStep(const config::DeclaredMap& declared, const Timing& timing) {
  const config::Map& map = declared.MapWith("at_s");
  const double at_s = map.Number("at_s", {0.0, kLongest_s});
  if (!(at_s >= 0.0 && at_s <= kLongest_s))
    return std::nullopt;  // said already; as steps it may be more than a number holds
  const double periods = at_s * 1e9 / static_cast<double>(timing.period * timing.base_step_ns);
  const auto whole = static_cast<std::int64_t>(std::llround(periods));
  if (std::fabs(periods - static_cast<double>(whole)) > 1e-6 * std::max(1.0, periods)) {
    const auto below = static_cast<std::int64_t>(std::floor(periods)) * timing.period;
    constexpr const char* kNoMultiple =
        "'at_s' is {}; a multiple of the scenario's period of {} s was expected, {} or {}";
    map.Problem("at_s", "config.out_of_range",
                fmt::format(kNoMultiple, at_s, SecondsText(timing.period, timing), SecondsText(below, timing),
                            SecondsText(below + timing.period, timing)));
    return std::nullopt;
  }
  const std::int64_t step = whole * timing.period;
  if (step < timing.delay) {
    constexpr const char* kTooEarly =
        "'at_s' is {}; the first time at which an event can act was expected, {} s, or a later one";
    map.Problem("at_s", "config.out_of_range", fmt::format(kTooEarly, at_s, SecondsText(timing.delay, timing)));
    return std::nullopt;
  }
  return step;
}

Event ReadEvent(const config::DeclaredMap& declared) {
  const config::Map& map = declared.map();
  Event event;
  event.name = declared.Word("name");
  const EventKind* kind = FindEventKind(event.name);
  if (kind == nullptr) return event;
  const std::string argument_key(kind->argument_key);
  event.argument = declared.MapWith(argument_key).Text(argument_key);
  const bool told = map.Has(argument_key) && (kind->argument != ArgumentKind::kAgentOnLane || map.Has("at"));
  if (kind->argument == ArgumentKind::kAgent && map.Has("at")) {
    const config::DeclaredMap at = declared.Child("at");
    const std::string road = at.MapWith("road").Text("road");
    event.argument = AgentText(event.argument, {road, at.Number("s_m")});
  }
  if (kind->argument == ArgumentKind::kAgentOnLane) {
    if (!map.Has("at")) (void)map.Child("at");  // the problem of a missing mapping
    const config::DeclaredMap at = declared.Child("at");
    const std::string lane = at.MapWith("lane").Text("lane");
    event.argument = AgentText(event.argument, {lane, at.Number("s_m")});
  }
  if (kind->value == ValueKind::kSide)
    event.value = declared.MapWith(kind->value_key).Choice(kind->value_key, {"left", "right"}) == "right" ? -1.0 : 1.0;
  else if (!kind->value_key.empty())
    event.value = declared.MapWith(kind->value_key).Number(kind->value_key, {kind->low, kind->high});
  // A value out of its range is said already.
  const Event argument_only{event.name, event.argument, std::clamp(event.value, kind->low, kind->high)};
  if (const base::Status sound = CheckEvent(argument_only); told && !sound)
    map.Problem(argument_key, sound.error().id, sound.error().message);
  return event;
}

}  // namespace

Scenario ReadScenario(const config::Map& root, const Timing& timing) {
  Scenario scenario;
  const config::DeclaredMap declared(root, ScenarioSchema().keys);
  (void)declared.Word("rodeira");
  (void)declared.Text("name");
  scenario.weather = weather::ReadWeather(declared.Items("weather").list());
  // One with weather only needs no events.
  if (!root.Has("weather")) (void)root.Items("events");
  const config::DeclaredList events = declared.Items("events");
  for (std::size_t i = 0; i < events.size(); ++i) {
    const config::DeclaredMap item = events.At(i);
    const config::Map& map = item.map();
    Event event = ReadEvent(item);
    if (map.Has("when")) {
      if (map.Has("at_s"))
        map.Problem("at_s", "config.conflicting_keys", "an event has 'at_s' and 'when'; one of them was expected");
      map.IgnoreKey("at_s");
      const config::DeclaredMap when = item.Child("when");
      const double passes_m = when.Number("passes_m");
      scenario.conditional.push_back({when.Text("road", ""), passes_m, std::move(event), when.map().Place()});
      continue;
    }
    const auto step = ReadStep(item, timing);
    if (!step) continue;
    if (!scenario.scheduled.empty() && *step < scenario.scheduled.back().step) {
      constexpr const char* kDescends = "'at_s' is {} and follows {}; times that do not descend were expected";
      map.Problem(
          "at_s", "config.wrong_order",
          fmt::format(kDescends, SecondsText(*step, timing), SecondsText(scenario.scheduled.back().step, timing)));
    }
    scenario.scheduled.push_back({*step, std::move(event), map.Place()});
  }
  return scenario;
}

base::Result<Scenario> LoadScenario(const std::filesystem::path& path, const Timing& timing) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  Scenario scenario = ReadScenario(file.value().root(), timing);
  if (const base::Status status = file.value().Finish(); !status) return status.error();
  return scenario;
}

}  // namespace rodeira::scenario

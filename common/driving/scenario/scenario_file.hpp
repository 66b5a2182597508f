// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/config/config.hpp"
#include "common/driving/scenario/event.hpp"
#include "common/world/weather/weather_plan.hpp"

namespace rodeira::scenario {

// Of the node that publishes, in base steps: its samples are valid at delay, delay + period, …
struct Timing {
  std::int64_t base_step_ns = 1'000'000;
  std::int64_t period = 10;
  std::int64_t delay = 10;
};

// An event and the step of its sample.
struct ScheduledEvent {
  std::int64_t step = 0;
  Event event;
  std::string place;  // file:line
};

// Once, when the driver's car passes a station of a road, in either direction.
struct ConditionalEvent {
  std::string road;
  double passes_m = 0.0;  // s of the road's axis
  Event event;
  std::string place;  // file:line
};

// `rodeira: scenario/1` (docs/reference/scenario-files.md).
struct Scenario {
  std::vector<ScheduledEvent> scheduled;  // by step, then as they stand in the file
  std::vector<ConditionalEvent> conditional;
  weather::WeatherPlan weather;
};

// Problems stay in the file's collection: a time that is no multiple of the period or before the first sample, times
// that descend, a name that is no EventKind, an argument or a value that does not belong to it.
Scenario ReadScenario(const config::Map& root, const Timing& timing);
// Wrong input, with places, where the file is missing or has problems.
base::Result<Scenario> LoadScenario(const std::filesystem::path& path, const Timing& timing);

}  // namespace rodeira::scenario

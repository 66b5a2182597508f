// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/core/config/config.hpp"
#include "common/world/weather/weather.hpp"

namespace rodeira::weather {

// From `at_s` on, within `over_s` and evenly, what is named becomes this; the rest stays as it is or goes on changing.
struct Change {
  double at_s = 0.0;
  double over_s = 0.0;  // 0: at once
  std::optional<double> wetness, rain_mmph, visibility_m, clouds, hour;
};

// The weather of a run as a function of time alone. A change of a quantity that is still changing begins where that one
// is then. The visibility changes evenly in its reciprocal (which is how fog looks); the hour goes forward, past
// midnight if it must.
class WeatherPlan {
 public:
  WeatherPlan() = default;
  // `changes` by time.
  explicit WeatherPlan(std::vector<Change> changes) : changes_(std::move(changes)) {}

  // time_s: seconds since the run's beginning; what no change names has its value of Weather{}.
  Weather At(double time_s) const;
  // One more, behind those of its time and before later ones.
  void Add(const Change& change);
  // One more before all others, which must not begin before it.
  void Begin(const Change& change) { changes_.insert(changes_.begin(), change); }

 private:
  std::vector<Change> changes_;
};

// What a mapping says of a weather without times (docs/reference/scenario-files.md), at once at the beginning. Problems
// stay in the file's collection.
Change ReadConstant(const config::Map& map);

// A list of changes (docs/reference/scenario-files.md). Problems stay in the file's collection.
WeatherPlan ReadWeather(const config::List& changes);

}  // namespace rodeira::weather

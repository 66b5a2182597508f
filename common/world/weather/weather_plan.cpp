// SPDX-License-Identifier: Apache-2.0
#include "common/world/weather/weather_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rodeira::weather {
namespace {

constexpr double kLongest_s = 1e6;
constexpr double kDay_h = 24.0;

double WrapHour(double hour) {
  const double wrapped = std::fmod(hour, kDay_h);
  return wrapped < kDay_h ? wrapped : 0.0;
}

// One quantity: from a value to another one, evenly in itself or in its reciprocal.
class Course {
 public:
  explicit Course(double value, bool reciprocal = false) : from_(value), to_(value), reciprocal_(reciprocal) {}

  double At(double now_s) const {
    if (now_s >= begin_s_ + over_s_) return to_;
    const double share = (now_s - begin_s_) / over_s_;
    if (reciprocal_) return 1.0 / (1.0 / from_ + (1.0 / to_ - 1.0 / from_) * share);
    return from_ + (to_ - from_) * share;
  }
  void Turn(double now_s, double target, double within_s) {
    from_ = At(now_s);
    to_ = target;
    begin_s_ = now_s;
    over_s_ = within_s;
  }

 private:
  double from_, to_;
  double begin_s_ = 0.0, over_s_ = 0.0;
  bool reciprocal_;
};

}  // namespace

Weather WeatherPlan::At(double time_s) const {
  const Weather first;
  Course wetness(first.wetness), rain(first.rain_mmph), visibility(first.visibility_m, true), clouds(first.clouds),
      hour(first.hour);
  for (const Change& change : changes_) {
    if (change.at_s > time_s) break;
    if (change.wetness) wetness.Turn(change.at_s, *change.wetness, change.over_s);
    if (change.rain_mmph) rain.Turn(change.at_s, *change.rain_mmph, change.over_s);
    if (change.visibility_m) visibility.Turn(change.at_s, *change.visibility_m, change.over_s);
    if (change.clouds) clouds.Turn(change.at_s, *change.clouds, change.over_s);
    if (change.hour) {
      const double now = hour.At(change.at_s);
      hour.Turn(change.at_s, now + WrapHour(*change.hour - WrapHour(now) + kDay_h), change.over_s);
    }
  }
  return {wetness.At(time_s), rain.At(time_s), visibility.At(time_s), clouds.At(time_s), WrapHour(hour.At(time_s))};
}

void WeatherPlan::Add(const Change& change) {
  const auto later = std::upper_bound(changes_.begin(), changes_.end(), change.at_s,
                                      [](double at_s, const Change& other) { return at_s < other.at_s; });
  changes_.insert(later, change);
}

Change ReadStanding(const config::Map& map) {
  const auto optional = [&](std::string_view key, config::Range range) {
    const double value = map.Number(key, range, std::numeric_limits<double>::quiet_NaN());
    return std::isnan(value) ? std::nullopt : std::optional(value);
  };
  Change change;
  change.wetness = optional("wetness", {0.0, 1.0});
  change.rain_mmph = optional("rain_mmph", {0.0, 200.0});
  change.visibility_m = optional("visibility_m", {10.0, kClear_m});
  change.clouds = optional("clouds", {0.0, 1.0});
  change.hour = optional("hour", {0.0, std::nextafter(kDay_h, 0.0)});
  return change;
}

WeatherPlan ReadWeather(const config::List& items) {
  std::vector<Change> changes;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const config::Map map = items.At(i);
    Change change = ReadStanding(map);
    change.at_s = map.Number("at_s", {0.0, kLongest_s}, 0.0);
    change.over_s = map.Number("over_s", {0.0, kLongest_s}, 0.0);
    if (!changes.empty() && change.at_s < changes.back().at_s) {
      map.Problem("at_s", "config.wrong_order",
                  fmt::format("'at_s' is {} and follows {}; times that do not descend were expected", change.at_s,
                              changes.back().at_s));
    }
    changes.push_back(change);
  }
  return WeatherPlan(std::move(changes));
}

}  // namespace rodeira::weather

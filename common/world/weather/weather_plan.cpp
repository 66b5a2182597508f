// SPDX-License-Identifier: Apache-2.0
#include "common/world/weather/weather_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/config/declared.hpp"
#include "common/world/weather/weather_schema.hpp"

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

const std::vector<config::Key>& ConstantWeatherKeys() {
  const auto key = [](std::string name, config::Range range, double first, std::string meaning) {
    return config::WithDefaultNote(fmt::format("unchanged, {} at first", first),
                                   config::OptionalNumberKey(std::move(name), range, std::move(meaning)));
  };
  static const Weather first;
  static const std::vector<config::Key> keys{
      key("wetness", {0.0, 1.0}, first.wetness, "Dry to a closed film of water."),
      key("rain_mmph", {0.0, 200.0}, first.rain_mmph, "Falling rain, drawn only."),
      key("visibility_m", {10.0, kClear_m}, first.visibility_m, "Meteorological optical range."),
      key("clouds", {0.0, 1.0}, first.clouds, "None to overcast."),
      key("hour", {0.0, std::nextafter(kDay_h, 0.0)}, first.hour,
          "Sun of an equinox, 42 degrees north; goes forward.")};
  return keys;
}

const std::vector<config::Key>& WeatherChangeKeys() {
  static const std::vector<config::Key> keys = [] {
    std::vector<config::Key> all{
        config::NumberKey("at_s", {0.0, kLongest_s}, 0.0, "Begin of the change; times do not descend."),
        config::NumberKey("over_s", {0.0, kLongest_s}, 0.0, "How long it takes, evenly.")};
    all.insert(all.end(), ConstantWeatherKeys().begin(), ConstantWeatherKeys().end());
    return all;
  }();
  return keys;
}

Change ReadConstant(const config::Map& map) {
  const config::DeclaredMap declared(map, ConstantWeatherKeys());
  Change change;
  change.wetness = declared.OptionalNumber("wetness");
  change.rain_mmph = declared.OptionalNumber("rain_mmph");
  change.visibility_m = declared.OptionalNumber("visibility_m");
  change.clouds = declared.OptionalNumber("clouds");
  change.hour = declared.OptionalNumber("hour");
  return change;
}

WeatherPlan ReadWeather(const config::List& items) {
  std::vector<Change> changes;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const config::Map map = items.At(i);
    Change change = ReadConstant(map);
    const config::DeclaredMap declared(map, WeatherChangeKeys());
    change.at_s = declared.Number("at_s");
    change.over_s = declared.Number("over_s");
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

// SPDX-License-Identifier: Apache-2.0
#include "common/world/weather/named_weather.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "common/core/base/suggest.hpp"

namespace rodeira::weather {
namespace {

Change Of(double wetness, double rain_mmph, double visibility_m, double clouds,
          std::optional<double> hour = std::nullopt) {
  Change change;
  change.wetness = wetness;
  change.rain_mmph = rain_mmph;
  change.visibility_m = visibility_m;
  change.clouds = clouds;
  change.hour = hour;
  return change;
}

}  // namespace

std::span<const NamedWeather> NamedWeathers() {
  static const std::array kAll{
      NamedWeather{"fine", Of(0.0, 0.0, kClear_m, 0.3, 13.5)}, NamedWeather{"overcast", Of(0.0, 0.0, 20'000.0, 1.0)},
      NamedWeather{"rain", Of(0.8, 12.0, 3'000.0, 1.0)},       NamedWeather{"fog", Of(0.2, 0.0, 120.0, 0.8)},
      NamedWeather{"dusk", Of(0.0, 0.0, 40'000.0, 0.3, 17.9)}, NamedWeather{"night", Of(0.0, 0.0, kClear_m, 0.2, 22.0)},
  };
  return kAll;
}

base::Result<Change> FindWeather(std::string_view name) {
  const auto all = NamedWeathers();
  const auto found =
      std::find_if(all.begin(), all.end(), [name](const NamedWeather& weather) { return weather.name == name; });
  if (found != all.end()) return found->change;
  std::vector<std::string> names;
  for (const NamedWeather& weather : all) names.emplace_back(weather.name);
  return base::WrongInput("world.unknown_weather",
                          fmt::format("'{}' is no weather{}", name.substr(0, 40), base::DidYouMean(name, names)));
}

}  // namespace rodeira::weather

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/world/weather/weather_plan.hpp"

namespace rodeira::weather {

// Weathers that a person asks for by a word: fine, overcast, rain, fog, dusk, night. All of it is said, so that each is
// the same whatever was before; but for the hour, which only dusk, night and fine change.
struct NamedWeather {
  std::string_view name;
  Change change;
};
std::span<const NamedWeather> NamedWeathers();
// Wrong input with the nearest word where there is none of the name.
base::Result<Change> FindWeather(std::string_view name);

}  // namespace rodeira::weather

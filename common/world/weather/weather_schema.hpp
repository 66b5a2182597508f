// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::weather {

// The keys of a weather without times; of a change.
const std::vector<config::Key>& ConstantWeatherKeys();
const std::vector<config::Key>& WeatherChangeKeys();

}  // namespace rodeira::weather

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Drivers who differ in nothing but the length of their cars.
inline TrafficSettings Identical(std::uint32_t vehicles, double acceleration_mps2) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.variety = 0.0;
  settings.speed_factor_low = settings.speed_factor_high = 1.0;
  settings.idm.acceleration_mps2 = acceleration_mps2;
  return settings;
}

}  // namespace rodeira::traffic

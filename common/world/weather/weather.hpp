// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::weather {

inline constexpr double kClear_m = 100'000.0;  // so far one sees where nothing else is said

// The same everywhere in the world.
struct Weather {
  double wetness = 0.0;            // of roads and ground: 0 dry … 1 a closed film of water
  double rain_mmph = 0.0;          // falling: mm an hour
  double visibility_m = kClear_m;  // meteorological optical range: a contrast is a twentieth of itself there
  double clouds = 0.3;             // 0 none … 1 overcast
  double hour = 13.5;              // of the day, 12 where the sun is highest; in [0, 24)

  bool operator==(const Weather&) const = default;
};

}  // namespace rodeira::weather

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "common/world/weather/weather.hpp"

namespace rodeira::scene {

// What the weather does to light, as the shaders need it. Colours and lights are linear shares of the screen's white.
struct Air {
  Eigen::Vector3f sun_W = Eigen::Vector3f::UnitZ();  // towards it, unit length, also below the horizon
  // A surface's light: base + (from above: 1, from below: 0) sky + (cosine to the sun) sun.
  Eigen::Vector3f base_light, sky_light, sun_light;
  Eigen::Vector3f horizon, zenith;  // of the sky without clouds in it
  float disc = 1.0F;                // how bright the sun itself is in the sky, 1: of a clear day
  float cloud_light = 1.0F;         // of the clouds, 1: white
  float clouds = 0.3F;              // 0 … 1 as the weather says
  float fog_per_m = 0.0F;           // a colour at distance d is exp(-fog d) of itself, beside the haze of a clear day
  float wetness = 0.0F;
  float rain = 0.0F;        // 0 … 1: none … a cloudburst (50 mm an hour and more)
  float dusk = 0.0F;        // what headlights add to what is lit: 1 at night, a tenth by day
  float headlights = 0.0F;  // the same where people have them on, else 0
};

// Height of the sun over the horizon: at 42 degrees north (Galicia) at an equinox,
//   sin h = cos 42° cos H with H = 15° (hour - 12).
double SunHeight_rad(double hour);

// A pure function. Without other words (Weather{}) a clear early afternoon. Fog: exp(-3 d / visibility), which leaves a
// twentieth at the visibility's distance. Headlights are on where the sun is lower than 3 degrees, the visibility below
// 300 m, or it rains.
Air MakeAir(const weather::Weather& weather);

}  // namespace rodeira::scene

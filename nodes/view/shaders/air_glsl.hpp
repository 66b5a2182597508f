// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::nodes {

// The sky over a direction given by its height (1: zenith), without sun and clouds; haze and fog have its horizon's
// colour.
inline constexpr const char* kAirGlsl = R"(
uniform vec3 horizon_colour;
uniform vec3 zenith_colour;
uniform float fog_per_m;
vec3 FogColour() { return horizon_colour * vec3(0.93, 0.96, 1.0); }
vec3 SkyColour(float up) { return mix(horizon_colour, zenith_colour, pow(clamp(up, 0.0, 1.0), 0.55)); }
// How much of what is so far off is seen through the haze.
float Clear(float distance_m) { return exp(-pow(distance_m * 1.6e-4, 1.3) - fog_per_m * distance_m); }
)";

}  // namespace rodeira::nodes

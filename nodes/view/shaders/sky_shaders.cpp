// SPDX-License-Identifier: Apache-2.0
// The sky, and the rain before the eye.
#include "nodes/view/shaders/air_glsl.hpp"
#include "nodes/view/shaders/shaders.hpp"

namespace rodeira::nodes {
namespace {

// The sky without the sun itself. `FINE`: asked at every pixel, otherwise at the dome's vertices.
std::string SkyHead() {
  return std::string(R"(#version 120
#pragma import_defines(FINE)
varying vec3 direction;
uniform vec3 sun_world;
uniform float sun_disc;
uniform float clouds;
uniform float cloud_light;
uniform sampler2D noise;
#ifndef FINE
varying vec3 sky;
#endif
)") + kAirGlsl +
         R"(
vec3 CloudySky(vec3 d) {
  vec3 colour = SkyColour(d.z);
  vec2 cloud_at = d.xy / (max(d.z, 0.0) + 0.12);
  float cloud = texture2D(noise, cloud_at * 0.11).g * 0.6 + texture2D(noise, cloud_at * 0.31 + 0.37).g * 0.3 +
                texture2D(noise, cloud_at * 0.9).g * 0.1;
  float low = 0.52 + (0.3 - clouds) * (clouds < 0.3 ? 1.2 : 0.6);
  float cover = smoothstep(low, low + 0.26, cloud) * smoothstep(0.02, 0.25, d.z);
  return mix(colour, vec3(0.97, 0.97, 0.98) * cloud_light, 0.75 * cover);
}
vec3 SunLit(vec3 colour, vec3 d) {
  float towards = max(dot(d, sun_world), 0.0);
  return colour + sun_disc * vec3(1.0, 0.92, 0.75) * (0.25 * pow(towards, 24.0) + 2.0 * pow(towards, 1800.0));
}
// Beyond the edge of the world there is land, far and hazy. The fog is 300 m thick.
vec3 OverLand(vec3 colour, vec3 d) {
  float bright = dot(horizon_colour, vec3(0.30, 0.59, 0.11)) / 0.85;
  colour = mix(colour, vec3(0.52, 0.57, 0.42) * bright, 0.85 * (1.0 - smoothstep(-0.06, 0.0, d.z)));
  return mix(FogColour(), colour, exp(-fog_per_m * 300.0 / max(d.z, 0.02)));
}
)";
}

}  // namespace

std::string SkyVertexShader() {
  return SkyHead() + R"(
void main() {
  direction = gl_Vertex.xyz;
#ifndef FINE
  sky = OverLand(SunLit(CloudySky(direction), direction), direction);
#endif
  vec4 p = gl_ProjectionMatrix * vec4(mat3(gl_ModelViewMatrix) * gl_Vertex.xyz, 1.0);
  gl_Position = vec4(p.xy, p.w * 0.999999, p.w);
}
)";
}

std::string SkyFragmentShader() {
  return SkyHead() + R"(
void main() {
#ifdef FINE
  vec3 d = normalize(direction);
  gl_FragColor = vec4(min(OverLand(SunLit(CloudySky(d), d), d), 1.0), 1.0);
#else
  gl_FragColor = vec4(min(sky, 1.0), 1.0);
#endif
}
)";
}

std::string RainVertexShader() {
  return R"(#version 120
varying vec2 at;
void main() {
  at = gl_Vertex.xy;
  gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0);
}
)";
}

std::string RainFragmentShader() {
  return R"(#version 120
varying vec2 at;
uniform float rain;
uniform float aspect;
uniform float time_s;
uniform vec3 horizon_colour;
uniform sampler2D noise;
// Drops nearer to the eye are longer, wider apart and faster.
float Streaks(float apart, float fall) {
  vec2 p = vec2(at.x * aspect + 0.06 * at.y, at.y) / apart;
  float drop = texture2D(noise, vec2(p.x, 0.035 * p.y + fract(fall * time_s))).r;
  float edge = 0.82 - 0.24 * rain;
  return smoothstep(edge, edge + 0.12, drop);
}
void main() {
  float seen = 0.5 * Streaks(0.55, 0.9) + 0.4 * Streaks(0.9, 1.3) + 0.3 * Streaks(1.6, 1.9);
  gl_FragColor = vec4(min(horizon_colour * 1.15 + 0.04, 1.0), 0.7 * seen * sqrt(rain));
}
)";
}

}  // namespace rodeira::nodes

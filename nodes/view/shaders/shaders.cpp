// SPDX-License-Identifier: Apache-2.0
// What is seen of a surface, by its material.
#include "nodes/view/shaders/shaders.hpp"

#include <fmt/format.h>

#include "common/view/scene/heat_map/heat_raster.hpp"
#include "common/view/scene/vehicles/car_lights.hpp"
#include "nodes/view/shaders/air_glsl.hpp"
#include "nodes/view/shaders/placed_glsl.hpp"

namespace rodeira::nodes {
namespace {

constexpr const char* kHead = R"(#version 120
#pragma import_defines(HEADLIGHTS, WET, SUN_SHADOW, SOFT_SHADOW, FINE, FOG, HEAT, INSTANCED)
#if defined(FINE) || defined(FOG)
#define HAZE_BY_PIXEL
#endif
varying vec3 at_eye;
varying vec3 normal_eye;
varying vec3 daylight;
varying vec2 ground;
#ifndef HAZE_BY_PIXEL
varying float clear;
#endif
uniform vec3 sun_eye;
uniform vec3 up_eye;
#ifdef SUN_SHADOW
varying vec3 sunlight;
varying vec3 in_sun;
#endif
#ifdef HEAT
varying vec3 in_heat;
#endif
)";

// What falls on a surface by day and from the headlights of the car that is watched: a dipped beam, bright to some 60
// m, or the main beam, which has no upper edge and reaches two and a half times as far. `sunny`: how much of the sun
// gets there past what throws shadows; beyond the maps everything does.
constexpr const char* kLight = R"(
vec3 light;
float sunny = 1.0;
#ifdef SUN_SHADOW
uniform sampler2DShadow sun_map;
uniform sampler2DShadow wide_sun_map;
uniform float sun_map_texel;
uniform vec4 to_wide;
float SunnyNear() {
#ifdef SOFT_SHADOW
  float soft = sun_map_texel * 0.75;
  return 0.25 * (shadow2D(sun_map, in_sun + vec3(soft, soft, 0.0)).r +
                 shadow2D(sun_map, in_sun + vec3(-soft, soft, 0.0)).r +
                 shadow2D(sun_map, in_sun + vec3(soft, -soft, 0.0)).r +
                 shadow2D(sun_map, in_sun + vec3(-soft, -soft, 0.0)).r);
#else
  return shadow2D(sun_map, in_sun).r;
#endif
}
// Towards the edge of the sharp map its shadows fade into those of the wide one.
float Sunny() {
  vec2 aside = abs(in_sun.xy - 0.5);
  float beyond = smoothstep(0.44, 0.495, max(aside.x, aside.y));
  if (beyond <= 0.0) return SunnyNear();
  float far = shadow2D(wide_sun_map, vec3(in_sun.xy * to_wide.w, in_sun.z) + to_wide.xyz).r;
  return beyond >= 1.0 ? far : mix(SunnyNear(), far, beyond);
}
#endif
#ifdef HEADLIGHTS
uniform float headlights;
uniform float main_beam;
uniform vec3 lamp_eye;
uniform vec3 lamp_ahead_eye;
vec3 Beam() {
  vec3 from = at_eye - lamp_eye;
  float distance_m = length(from);
  vec3 ray = from / max(distance_m, 0.1);
  float ahead = dot(ray, lamp_ahead_eye);
  float above = dot(ray - lamp_ahead_eye * ahead, up_eye);
  float cone = smoothstep(0.80, 0.97, ahead) * (1.0 - 0.9 * (1.0 - main_beam) * smoothstep(-0.01, 0.02, above));
  float facing = 0.3 + 0.7 * max(dot(-ray, normalize(normal_eye)), 0.0);
  return vec3(1.0, 0.95, 0.84) *
         (headlights * 2.4 * cone * facing / (1.0 + pow(distance_m / (24.0 + 36.0 * main_beam), 2.0)));
}
#endif
)";

// Water darkens stone and mirrors the sky the more, the flatter one looks at it; most where it stands.
constexpr const char* kWater = R"(
uniform sampler2D noise;
uniform float wetness;
#ifndef WET
vec3 Wet(vec3 dry) { return dry; }
#else
vec3 Wet(vec3 dry) {
  vec3 view = normalize(at_eye);
  vec3 n = normalize(normal_eye);
  float flat_look = pow(1.0 - max(dot(-view, n), 0.0), 10.0);
  float standing = 0.45 + 0.55 * smoothstep(0.40, 0.62, texture2D(noise, ground / 24.0).g);
  vec3 mirrored = SkyColour(dot(reflect(view, n), up_eye));
  return mix(dry * (1.0 - 0.42 * wetness), mirrored, wetness * standing * (0.02 + 0.70 * flat_look));
}
#endif
)";

// A statistic over the ground (scene::HeatRaster), smooth from the middle of a square to that of the next on the same
// surface; red through yellow to green, of which so much in one covers what is seen of the ground.
constexpr const char* kHeat = R"(
#ifndef HEAT
vec3 Heated(vec3 seen) { return seen; }
#else
uniform sampler2D heat_map;
uniform vec3 heat_size;
// A square's share of the scale, and 1 where there is one.
vec2 HeatOf(vec2 square) {
  vec4 both = texture2D(heat_map, (square + 0.5) / heat_size.xy);
  vec2 away = abs(both.yw * heat_size.z - in_heat.z);
  if (both.y > 0.0 && away.x < HEAT_SURFACE) return vec2(both.x, 1.0);
  if (both.w > 0.0 && away.y < HEAT_SURFACE) return vec2(both.z, 1.0);
  return vec2(0.0);
}
vec3 Heated(vec3 seen) {
  if (HeatOf(floor(in_heat.xy)).y == 0.0) return seen;
  vec2 corner = floor(in_heat.xy - 0.5);
  vec2 part = in_heat.xy - 0.5 - corner;
  vec2 south = mix(HeatOf(corner), HeatOf(corner + vec2(1.0, 0.0)), part.x);
  vec2 north = mix(HeatOf(corner + vec2(0.0, 1.0)), HeatOf(corner + vec2(1.0, 1.0)), part.x);
  vec2 sum = mix(south, north, part.y);
  float share = sum.x / sum.y;
  return mix(seen, clamp(vec3(2.0 - 2.0 * share, 2.0 * share, 0.0), 0.0, 1.0), HEAT_SHARE);
}
#endif
)";

const char* FragmentBody(scene::Material material) {
  switch (material) {
    case scene::Material::kGround:
      return R"(
uniform sampler2D noise;
vec3 Look() {
#ifdef FINE
  float near = texture2D(noise, ground / 4.0).r + texture2D(noise, ground / 32.0).g;
#else
  float near = 0.5 + texture2D(noise, ground / 8.0).r;
#endif
  return gl_Color.rgb * light * (0.62 + 0.38 * near);
})";
    case scene::Material::kCheckers:
      return R"(
uniform sampler2D noise;
vec3 Look() {
  vec2 square = ground / 16.0;
  vec2 soft = clamp(abs(fract(square) - 0.5) * 2.0 / max(fwidth(square) * 2.0, 0.001), 0.0, 1.0);
  vec2 sign_xy = (step(0.5, fract(square * 0.5)) * 2.0 - 1.0);
  float far = clamp(1.6 - max(fwidth(square).x, fwidth(square).y) * 2.0, 0.0, 1.0);
  float checker = sign_xy.x * sign_xy.y * far;
  float grain = texture2D(noise, ground / 4.0).r;
  return gl_Color.rgb * light * (0.9 + 0.10 * checker + 0.2 * (grain - 0.5));
})";
    case scene::Material::kRoad:
      return R"(
vec3 Look() {
#ifdef FINE
  float grain = texture2D(noise, ground / 2.0).r;
  float wear = texture2D(noise, ground / 16.0).g;
#else
  float grain = texture2D(noise, ground / 2.0).r, wear = 0.5;
#endif
  return Wet(gl_Color.rgb * light * (0.80 + 0.24 * grain + 0.16 * wear));
})";
    // Slabs are even and pale, with pores and large soft stains.
    case scene::Material::kConcrete:
      return R"(
vec3 Look() {
  float pores = smoothstep(0.30, 0.42, texture2D(noise, ground / 1.5).r);
  float stains = texture2D(noise, ground / 24.0).g;
  return Wet(gl_Color.rgb * light * (0.78 + 0.10 * pores + 0.26 * stains));
})";
    // Stones of some centimetres, each of its own grey, dark between them.
    case scene::Material::kGravel:
      return R"(
uniform float wetness;
uniform sampler2D noise;
vec3 Look() {
  float stones = texture2D(noise, ground / 2.0).r + 0.6 * texture2D(noise, ground * 1.7 / 2.0 + 0.31).r;
  float wear = texture2D(noise, ground / 16.0).g;
  return gl_Color.rgb * light * (0.50 + 0.85 * smoothstep(0.45, 1.15, stones) + 0.14 * wear) * (1.0 - 0.42 * wetness);
})";
    case scene::Material::kPicture:
      return R"(
uniform sampler2D noise;
uniform sampler2D face;
uniform float repeats;
varying vec2 on_face;
vec3 Look() {
  vec2 beyond = abs(on_face - 0.5);
  float there = max(repeats, 1.0 - step(0.5, max(beyond.x, beyond.y)));
  float near = texture2D(noise, ground / 4.0).r + texture2D(noise, ground / 32.0).g;
  vec3 bare = gl_Color.rgb * (0.62 + 0.38 * near);
  return mix(bare, texture2D(face, on_face).rgb, there) * light;
})";
    case scene::Material::kMark:
      return R"(
uniform sampler2D noise;
vec3 Look() {
  // Far away a line is thinner than a pixel: it fades into the asphalt instead of flickering.
  vec3 paint = mix(gl_Color.rgb, vec3(0.38), 0.9 * smoothstep(90.0, 480.0, length(at_eye)));
  return paint * light * (0.88 + 0.12 * texture2D(noise, ground / 2.0).r);
})";
    case scene::Material::kCarPaint:
      return R"(
uniform float pulse;
vec3 Look() {
  vec3 n = normalize(normal_eye);
  vec3 view = normalize(at_eye);
  vec3 mirrored = reflect(view, n);
  float fresnel = 0.04 + 0.5 * pow(1.0 - max(dot(-view, n), 0.0), 4.0);
  float up = dot(mirrored, up_eye);
  vec3 around = mix(vec3(0.25, 0.27, 0.22), SkyColour(up), smoothstep(-0.05, 0.05, up));
  float shine = sunny * pow(max(dot(mirrored, sun_eye), 0.0), 60.0);
  return mix(gl_Color.rgb * light + fresnel * around + 0.7 * shine, vec3(1.0, 0.95, 0.55), 0.65 * pulse);
})";
    case scene::Material::kGlass:
      return R"(
vec3 Look() {
  vec3 n = normalize(normal_eye);
  vec3 view = normalize(at_eye);
  vec3 mirrored = reflect(view, n);
  float fresnel = 0.10 + 0.75 * pow(1.0 - max(dot(-view, n), 0.0), 3.0);
  float up = dot(mirrored, up_eye);
  vec3 around = mix(vec3(0.20, 0.23, 0.17), SkyColour(up), smoothstep(-0.05, 0.05, up));
  return gl_Color.rgb * 0.6 * light + fresnel * around + 0.8 * sunny * pow(max(dot(mirrored, sun_eye), 0.0), 120.0);
})";
    case scene::Material::kLamp:
      return R"(
uniform float glow;
vec3 Look() { return gl_Color.rgb * glow; })";
    case scene::Material::kCarLamp:
      return R"(
varying float glowing;
vec3 Look() { return gl_Color.rgb * max(light * 0.85, vec3(glowing)); })";
    case scene::Material::kSign:
      return R"(
uniform sampler2D face;
varying vec2 on_face;
// Signs throw light back: they are never as dark as what stands in the shade.
vec3 Look() { return texture2D(face, on_face).rgb * max(light, vec3(0.72)); })";
    case scene::Material::kMatt:
      return R"(
uniform float pulse;
vec3 Look() { return mix(gl_Color.rgb * light, vec3(1.0, 0.95, 0.55), 0.65 * pulse); })";
    case scene::Material::kFoliage:
      break;
  }
  return R"(
vec3 Look() { return gl_Color.rgb * light; })";
}

}  // namespace

std::string VertexShader(scene::Material material) {
  return std::string(kHead) + kAirGlsl +
         (material == scene::Material::kCarLamp ? fmt::format("#define LAMPS {}\n", scene::kLamps) : std::string()) +
         kPlacedGlsl + R"(
varying vec2 on_face;
#ifdef LAMPS
uniform float glows[LAMPS];
varying float glowing;
#endif
uniform vec3 base_light;
uniform vec3 sky_light;
uniform vec3 sun_light;
#ifdef SUN_SHADOW
uniform mat4 eye_to_sun;
#endif
#ifdef HEAT
uniform mat4 eye_to_heat;
#endif
void main() {
  vec4 vertex = Placed();
  vec4 p = gl_ModelViewMatrix * vertex;
  gl_Position = gl_ProjectionMatrix * p;
  at_eye = p.xyz;
  normal_eye = normalize(gl_NormalMatrix * PlacedNormal());
  float sun = max(dot(normal_eye, sun_eye), 0.0);
  float sky = 0.5 + 0.5 * dot(normal_eye, up_eye);
  daylight = base_light + sky * sky_light;
#ifdef SUN_SHADOW
  sunlight = sun * sun_light;
  // 5 cm off the surface: a surface does not shade itself.
  in_sun = (eye_to_sun * vec4(p.xyz + 0.05 * normal_eye, 1.0)).xyz;
#else
  daylight += sun * sun_light;
#endif
#ifdef HEAT
  in_heat = (eye_to_heat * p).xyz;
#endif
  ground = vertex.xy;
#ifndef HAZE_BY_PIXEL
  clear = Clear(length(at_eye));
#endif
  gl_FrontColor = PlacedColour();
  on_face = gl_MultiTexCoord1.xy;
#ifdef LAMPS
  glowing = glows[int(gl_MultiTexCoord1.x + 0.5)];
#endif
}
)";
}

std::string FragmentShader(scene::Material material) {
  const bool stone = material == scene::Material::kRoad || material == scene::Material::kConcrete;
  const bool lies = scene::IsGround(material);
  const std::string heat = lies ? fmt::format("\n#define HEAT_SURFACE {:.3f}\n#define HEAT_SHARE {:.3f}\n{}",
                                              scene::kHeatSurface_m, scene::kHeatShare, kHeat)
                                : "\nvec3 Heated(vec3 seen) { return seen; }";
  return std::string(kHead) + kAirGlsl + kLight + (stone ? kWater : "") + FragmentBody(material) + heat + R"(
void main() {
  light = daylight;
#ifdef SUN_SHADOW
  sunny = Sunny();
  light += sunny * sunlight;
#endif
#ifdef HEADLIGHTS
  light += Beam();
#endif
#ifdef HAZE_BY_PIXEL
  float clear = Clear(length(at_eye));
#endif
  gl_FragColor = vec4(Heated(mix(FogColour(), Look(), clear)), 1.0);
}
)";
}

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/shaders/air_uniforms.hpp"

#include <osg/Uniform>

#include "nodes/view/materials/to_osg.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kLampHeight_m = 0.65;
constexpr std::int64_t kRainAgain_ns =
    10'000'000'000;  // the streaks' way fits into it: fractions of the texture a second are tenths

osg::Vec3f Turned(const osg::Vec3d& direction, const osg::Matrixd& view) {
  return osg::Matrixd::transform3x3(direction, view);
}

void Set(osg::StateSet& state, const char* name, float value) {
  state.getOrCreateUniform(name, osg::Uniform::FLOAT)->set(value);
}
void Set(osg::StateSet& state, const char* name, const osg::Vec3f& value) {
  state.getOrCreateUniform(name, osg::Uniform::FLOAT_VEC3)->set(value);
}

void Define(osg::StateSet& state, const char* word, bool on) {
  if (on)
    state.setDefine(word);
  else
    state.removeDefine(word);
}

}  // namespace

void SetAir(osg::StateSet& state, const scene::Air& air) {
  Set(state, "sun_world", ToOsgFloat(air.sun_W));
  Set(state, "base_light", ToOsgFloat(air.base_light));
  Set(state, "sky_light", ToOsgFloat(air.sky_light));
  Set(state, "sun_light", ToOsgFloat(air.sun_light));
  Set(state, "horizon_colour", ToOsgFloat(air.horizon));
  Set(state, "zenith_colour", ToOsgFloat(air.zenith));
  Set(state, "sun_disc", air.disc);
  Set(state, "clouds", air.clouds);
  Set(state, "cloud_light", air.cloud_light);
  Set(state, "fog_per_m", air.fog_per_m);
  Set(state, "wetness", air.wetness);
  Set(state, "rain", air.rain);
  Define(state, "WET", air.wetness > 0.0F);
  Define(state, "FOG", air.fog_per_m > 0.0F);  // too much from one vertex to the next
}

void SetEye(osg::StateSet& state, const scene::Air& air, const scene::CarPose* car, const osg::Matrixd& view) {
  Set(state, "sun_eye", Turned(osg::Vec3d(ToOsgFloat(air.sun_W)), view));
  Set(state, "up_eye", Turned({0.0, 0.0, 1.0}, view));
  const bool switched_on = car != nullptr && (car->lights.dipped || car->lights.main);
  const float headlights = car == nullptr ? 0.0F : switched_on ? air.dusk : air.headlights;
  Set(state, "headlights", headlights);
  Set(state, "main_beam", car != nullptr && car->lights.main ? 1.0F : 0.0F);
  Define(state, "HEADLIGHTS", headlights > 0.0F);
  const scene::CarPose none;
  const scene::CarPose& of = car != nullptr ? *car : none;
  const Eigen::Vector3d at = of.p_WB_W + of.q_WB * Eigen::Vector3d(of.front_m, 0.0, kLampHeight_m);
  const Eigen::Vector3d ahead = (of.q_WB * Eigen::Vector3d(1.0, 0.0, -0.012)).normalized();
  Set(state, "lamp_eye", osg::Vec3f(ToOsg(at) * view));
  Set(state, "lamp_ahead_eye", Turned(ToOsg(ahead), view));
}

void SetRain(osg::StateSet& state, std::int64_t time_ns, double aspect) {
  Set(state, "time_s", static_cast<float>(static_cast<double>(time_ns % kRainAgain_ns) * 1e-9));
  Set(state, "aspect", static_cast<float>(aspect));
}

}  // namespace rodeira::nodes

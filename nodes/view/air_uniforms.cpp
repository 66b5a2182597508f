#include "nodes/view/air_uniforms.hpp"

namespace rodeira::view {
namespace {

constexpr double kLampHeight_m = 0.65;
constexpr std::int64_t kRainAgain_ns = 10'000'000'000;  // the streaks' way fits into it: fractions of the texture a second are tenths

osg::Vec3f ToOsg(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }
osg::Vec3d ToOsg(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

AirUniforms::AirUniforms(osg::StateSet& root) : root_(root) {
  Set(scene::MakeAir({}), osg::Matrixd::identity());
  SetLamps(nullptr, {}, osg::Matrixd::identity());
  SetRain(0, 1.0);
}

void AirUniforms::Set(const char* name, float value) { root_.getOrCreateUniform(name, osg::Uniform::FLOAT)->set(value); }

void AirUniforms::Set(const char* name, const osg::Vec3f& value) { root_.getOrCreateUniform(name, osg::Uniform::FLOAT_VEC3)->set(value); }

void AirUniforms::Set(const scene::Air& air, const osg::Matrixd& view) {
  Set("sun_world", ToOsg(air.sun_W));
  Set("sun_eye", osg::Vec3f(osg::Matrixd::transform3x3(osg::Vec3d(ToOsg(air.sun_W)), view)));
  Set("up_eye", osg::Vec3f(osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, 1.0), view)));
  Set("base_light", ToOsg(air.base_light));
  Set("sky_light", ToOsg(air.sky_light));
  Set("sun_light", ToOsg(air.sun_light));
  Set("horizon_colour", ToOsg(air.horizon));
  Set("zenith_colour", ToOsg(air.zenith));
  Set("sun_disc", air.disc);
  Set("clouds", air.clouds);
  Set("cloud_light", air.cloud_light);
  Set("fog_per_m", air.fog_per_m);
  Set("wetness", air.wetness);
  Set("rain", air.rain);
}

void AirUniforms::SetLamps(const scene::CarPose* car, const scene::Air& air, const osg::Matrixd& view) {
  Set("headlights", car != nullptr ? air.headlights : 0.0F);
  const scene::CarPose none;
  const scene::CarPose& of = car != nullptr ? *car : none;
  const Eigen::Vector3d at = of.p_WB_W + of.q_WB * Eigen::Vector3d(of.front_m, 0.0, kLampHeight_m);
  const Eigen::Vector3d ahead = (of.q_WB * Eigen::Vector3d(1.0, 0.0, -0.012)).normalized();
  Set("lamp_eye", osg::Vec3f(ToOsg(at) * view));
  Set("lamp_ahead_eye", osg::Vec3f(osg::Matrixd::transform3x3(ToOsg(ahead), view)));
}

void AirUniforms::SetRain(std::int64_t time_ns, double aspect) {
  Set("time_s", static_cast<float>(static_cast<double>(time_ns % kRainAgain_ns) * 1e-9));
  Set("aspect", static_cast<float>(aspect));
}

}  // namespace rodeira::view

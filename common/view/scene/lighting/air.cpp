// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/lighting/air.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/view/scene/smooth_step.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr double kLatitude_rad = 42.0 * base::kRadiansPerDegree;

double HourAngle_rad(double hour) { return (hour - 12.0) * 15.0 * base::kRadiansPerDegree; }

// Colours of a cloudless sky and its light at a height of the sun; between two rows evenly.
struct Row {
  double height_deg;
  Vector3d base, sky, sun, horizon, zenith;
};
const std::array<Row, 5> kRows = {{
    {-12.0,
     {0.045, 0.050, 0.065},
     {0.030, 0.036, 0.055},
     {0.0, 0.0, 0.0},
     {0.055, 0.068, 0.105},
     {0.012, 0.020, 0.050}},
    {-4.0, {0.07, 0.08, 0.10}, {0.05, 0.06, 0.10}, {0.0, 0.0, 0.0}, {0.36, 0.28, 0.30}, {0.05, 0.08, 0.18}},
    {0.0, {0.15, 0.15, 0.16}, {0.10, 0.12, 0.17}, {0.10, 0.05, 0.02}, {0.86, 0.60, 0.42}, {0.14, 0.23, 0.42}},
    {12.0, {0.25, 0.26, 0.26}, {0.17, 0.20, 0.26}, {0.66, 0.53, 0.36}, {0.84, 0.80, 0.74}, {0.24, 0.42, 0.68}},
    {30.0, {0.30, 0.31, 0.30}, {0.20, 0.24, 0.30}, {0.78, 0.73, 0.62}, {0.80, 0.86, 0.91}, {0.27, 0.47, 0.76}},
}};

Row ClearSky(double height_deg) {
  if (height_deg <= kRows.front().height_deg) return kRows.front();
  for (std::size_t i = 1; i < kRows.size(); ++i) {
    const Row &a = kRows[i - 1], &b = kRows[i];
    if (height_deg >= b.height_deg) continue;
    const double share = (height_deg - a.height_deg) / (b.height_deg - a.height_deg);
    const auto mix = [share](const Vector3d& from, const Vector3d& to) { return Vector3d(from + share * (to - from)); };
    return {height_deg,        mix(a.base, b.base),       mix(a.sky, b.sky),
            mix(a.sun, b.sun), mix(a.horizon, b.horizon), mix(a.zenith, b.zenith)};
  }
  return kRows.back();
}

// The same brightness without colour.
Vector3d Grey(const Vector3d& colour) {
  return Vector3d::Constant(0.30 * colour.x() + 0.59 * colour.y() + 0.11 * colour.z());
}

}  // namespace

double SunHeight_rad(double hour) { return std::asin(std::cos(kLatitude_rad) * std::cos(HourAngle_rad(hour))); }

Air MakeAir(const weather::Weather& weather) {
  const double angle = HourAngle_rad(weather.hour);
  const Vector3d sun(-std::sin(angle), -std::sin(kLatitude_rad) * std::cos(angle),
                     std::cos(kLatitude_rad) * std::cos(angle));
  const double height_deg = SunHeight_rad(weather.hour) / base::kRadiansPerDegree;
  Row sky = ClearSky(height_deg);
  // Up to half of the sky clouds only stand in it; then they close it, take the sun and spread its light.
  const double closed = SmoothStep(weather.clouds, 0.5, 1.0), fog = SmoothStep(weather.visibility_m, 2000.0, 200.0);
  const double shaded = std::max(closed, fog);
  sky.base += shaded * 0.22 * sky.sun;
  sky.sky += shaded * 0.15 * sky.sun;
  sky.sun *= 1.0 - shaded;
  sky.horizon += shaded * (0.86 * Grey(sky.horizon) - sky.horizon);
  sky.zenith += shaded * (0.72 * Grey(sky.horizon) - sky.zenith);
  Air air;
  air.sun_W = sun.cast<float>();
  air.base_light = sky.base.cast<float>();
  air.sky_light = sky.sky.cast<float>();
  air.sun_light = sky.sun.cast<float>();
  air.horizon = sky.horizon.cast<float>();
  air.zenith = sky.zenith.cast<float>();
  air.disc = static_cast<float>((1.0 - shaded) * SmoothStep(height_deg, -2.0, 4.0));
  air.cloud_light = static_cast<float>(std::min(1.0, Grey(sky.horizon).x() * (1.0 + 0.17 * (1.0 - closed))));
  air.clouds = static_cast<float>(weather.clouds);
  air.fog_per_m = static_cast<float>(3.0 / weather.visibility_m - 3.0 / weather::kClear_m);
  air.wetness = static_cast<float>(weather.wetness);
  air.rain = static_cast<float>(std::min(1.0, std::sqrt(weather.rain_mmph / 50.0)));
  const bool on = height_deg < 3.0 || weather.visibility_m < 300.0 || weather.rain_mmph > 0.0;
  air.dusk = static_cast<float>(1.0 - 0.9 * SmoothStep(Grey(sky.base + sky.sky + 0.5 * sky.sun).x(), 0.15, 0.75));
  air.headlights = on ? air.dusk : 0.0F;
  return air;
}

}  // namespace rodeira::scene

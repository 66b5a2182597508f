// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/raster/dial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/view/scene/raster/lettering.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;

constexpr Colour kFace = Colour::Of(0x0b0c0f), kScale = Colour::Of(0xe8ebee), kDialRim = Colour::Of(0x3a3e44);

Vector2d On(double angle_rad, double radius) { return {radius * std::cos(angle_rad), radius * std::sin(angle_rad)}; }

}  // namespace

double NeedleAngle_rad(const Dial& dial, double value) {
  const double share = std::clamp(value / dial.most, 0.0, 1.0);
  return (225.0 - 270.0 * share) * base::kPi / 180.0;
}

Raster DrawDial(const Dial& dial, int size_px) {
  Canvas canvas(size_px, size_px, kFace);
  canvas.Disc(Vector2d::Zero(), 0.99, kDialRim);
  canvas.Disc(Vector2d::Zero(), 0.95, kFace);
  const auto tick = [&](double value, double from, double width) {
    const double angle = NeedleAngle_rad(dial, value);
    canvas.Bar(On(angle, from), On(angle, 0.92), width, kScale);
  };
  const int ticks = static_cast<int>(std::lround(dial.most / dial.ticks)),
            labels = static_cast<int>(std::lround(dial.most / dial.labelled));
  for (int i = 0; i <= ticks; ++i) tick(i * dial.ticks, 0.84, 0.014);
  const double height = labels > 8 ? 0.115 : labels > 3 ? 0.17 : 0.26;
  for (int i = 0; i <= labels; ++i) {
    const double value = i * dial.labelled;
    tick(value, 0.78, 0.028);
    Letter(canvas, fmt::format("{:.0f}", value / dial.divisor), On(NeedleAngle_rad(dial, value), 0.62), height, 0.30,
           kScale);
  }
  Letter(canvas, dial.unit, {0.0, -0.42}, labels > 3 ? 0.10 : 0.20, 0.7, kScale);
  return canvas.Paint();
}

Raster DrawGear(std::int32_t gear, int size_px) {
  Canvas canvas(size_px, size_px, kFace);
  Letter(canvas, gear < 0 ? "R" : gear == 0 ? "N" : fmt::format("{}", gear), Vector2d::Zero(), 1.3, 1.6, kScale);
  return canvas.Paint();
}

}  // namespace rodeira::scene

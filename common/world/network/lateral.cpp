// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/lateral.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::network {
namespace {

// A cross-section's height and its slope at t.
LateralPoint OnShape(const Shape& shape, double t_m) {
  const double first = shape.height.records().front().from;
  if (t_m < first) return {shape.height.Value(first), 0.0, 0.0};
  const geometry::CubicPoint at = shape.height.Evaluate(t_m);
  return {at.value, 0.0, at.slope};
}

LateralPoint OnShapes(const std::vector<Shape>& shapes, double s_m, double t_m) {
  const auto after =
      std::upper_bound(shapes.begin(), shapes.end(), s_m, [](double s, const Shape& shape) { return s < shape.s_m; });
  if (after == shapes.begin()) return OnShape(shapes.front(), t_m);
  const Shape& before = *(after - 1);
  LateralPoint point = OnShape(before, t_m);
  if (after == shapes.end()) return point;
  const LateralPoint next = OnShape(*after, t_m);
  const double length = after->s_m - before.s_m;
  const double part = (s_m - before.s_m) / length;
  point.slope_s = (next.z_m - point.z_m) / length;
  point.z_m += part * (next.z_m - point.z_m);
  point.slope_t += part * (next.slope_t - point.slope_t);
  return point;
}

// Height of a strip at u outward, and its derivatives by s (at fixed u) and by u. Most strips have a slope alone.
LateralPoint OnStrip(const SurfaceStrip& strip, double s_m, double u_m) {
  LateralPoint point;
  const auto add = [&](std::size_t n, double power, double power_slope) {
    if (strip.coefficients[n].empty()) return;
    const geometry::CubicPoint c = strip.coefficients[n].Evaluate(s_m);
    point.z_m += c.value * power;
    point.slope_s += c.slope * power;
    point.slope_t += c.value * power_slope;
  };
  add(0, 1.0, 0.0);
  add(1, u_m, 1.0);
  add(2, u_m * u_m, 2.0 * u_m);
  add(3, u_m * u_m * u_m, 3.0 * u_m * u_m);
  return point;
}

LateralPoint OnStrips(const CrossSectionSurface& surface, double s_m, double t_m) {
  const geometry::CubicPoint offset = surface.t_offset.Evaluate(s_m);
  const double sign = t_m >= offset.value ? 1.0 : -1.0;
  double u = sign * (t_m - offset.value);
  double u_slope = -sign * offset.slope;  // du/ds
  LateralPoint base;                      // the outer edge of the strip inside
  const std::vector<SurfaceStrip>& strips = sign > 0.0 ? surface.left : surface.right;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const SurfaceStrip& strip = strips[i];
    const geometry::CubicPoint width = strip.has_width ? strip.width.Evaluate(s_m) : geometry::CubicPoint{};
    const bool here = !strip.has_width || u <= width.value || i + 1 == strips.size();
    const double at = here ? u : width.value;
    LateralPoint point = OnStrip(strip, s_m, at);
    point.slope_s += point.slope_t * (here ? u_slope : width.slope);
    if (strip.relative) {
      point.z_m += base.z_m;
      point.slope_s += base.slope_s;
    }
    if (here) {
      point.slope_t *= sign;
      return point;
    }
    base = {point.z_m, point.slope_s, 0.0};
    u -= width.value;
    u_slope -= width.slope;
  }
  return base;
}

}  // namespace

bool LateralProfile::flat() const {
  return crossfall_left.zero() && crossfall_right.zero() && shapes.empty() && surface.left.empty() &&
         surface.right.empty();
}

LateralPoint LateralProfile::At(double s_m, double t_m) const {
  LateralPoint point;
  const auto add = [&point](const LateralPoint& more) {
    point.z_m += more.z_m;
    point.slope_s += more.slope_s;
    point.slope_t += more.slope_t;
  };
  if (!shapes.empty()) add(OnShapes(shapes, s_m, t_m));
  if (!surface.left.empty() || !surface.right.empty()) add(OnStrips(surface, s_m, t_m));
  const geometry::CubicTable& crossfall = t_m >= 0.0 ? crossfall_left : crossfall_right;
  if (!crossfall.empty()) {
    const geometry::CubicPoint angle = crossfall.Evaluate(s_m);
    const double fall = std::tan(angle.value), away = std::fabs(t_m);
    add({-away * fall, -away * (1.0 + fall * fall) * angle.slope, t_m >= 0.0 ? -fall : fall});
  }
  return point;
}

}  // namespace rodeira::network

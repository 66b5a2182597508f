// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/axis_feet.hpp"

#include <cmath>
#include <cstdint>

#include "common/core/geometry/small_arc_tangent.hpp"

namespace rodeira::geometry {
namespace {

using Numbers = AxisFeet::Numbers;

bool AllWithin(const Numbers& numbers, std::size_t count, double bound) {
  std::int64_t others = 0;  // counted, so that none is a branch
  for (std::size_t i = 0; i < count; ++i) others += std::fabs(numbers[i]) < bound ? 0 : 1;  // NaN too
  return others == 0;
}

void OnLine(const AxisPanel& panel, AxisFeet& feet) {
  const double x = panel.middle_W.x(), y = panel.middle_W.y(), ahead_x = panel.tangent_W.x(),
               ahead_y = panel.tangent_W.y();
  for (std::size_t i = 0; i < feet.count; ++i) {
    const double away_x = feet.x_m[i] - x, away_y = feet.y_m[i] - y;
    feet.u_m[i] = away_x * ahead_x + away_y * ahead_y;
    feet.t_m[i] = ahead_x * away_y - ahead_y * away_x;
    feet.tangent_x[i] = ahead_x;
    feet.tangent_y[i] = ahead_y;
    feet.curvature_1pm[i] = 0.0;
  }
}

// As PlanAxis::ArcFoot, for points with a direction from the centre by the short series.
bool OnArc(const AxisPanel& panel, AxisFeet& feet) {
  const double x0 = panel.middle_W.x(), y0 = panel.middle_W.y(), k = panel.curvature_1pm;
  const double ahead_x = panel.tangent_W.x(), ahead_y = panel.tangent_W.y(), left_x = -ahead_y, left_y = ahead_x;
  Numbers tangent_of_half;
  for (std::size_t i = 0; i < feet.count; ++i) {
    const double away_x = feet.x_m[i] - x0, away_y = feet.y_m[i] - y0;
    const double along = away_x * ahead_x + away_y * ahead_y, aside = away_x * left_x + away_y * left_y;
    const double x = 1.0 - k * aside, y = k * along, h = std::sqrt(x * x + y * y);
    tangent_of_half[i] = y / (h + x);
    feet.u_m[i] = 2.0 * SmallArcTangent(tangent_of_half[i]) / k;
    feet.t_m[i] = (2.0 * aside - k * (along * along + aside * aside)) / (1.0 + h);
    const double inverse = 1.0 / h;
    feet.tangent_x[i] = x * inverse * ahead_x + y * inverse * left_x;
    feet.tangent_y[i] = x * inverse * ahead_y + y * inverse * left_y;
    feet.curvature_1pm[i] = k;
  }
  return AllWithin(tangent_of_half, feet.count, kSmallTangent);
}

void OneByOne(const PlanAxis& axis, const AxisPanel& panel, AxisFeet& feet) {
  for (std::size_t i = 0; i < feet.count; ++i) {
    const AxisFoot foot = axis.Foot(panel, {feet.x_m[i], feet.y_m[i]});
    feet.u_m[i] = foot.u_m;
    feet.t_m[i] = foot.t_m;
    feet.tangent_x[i] = foot.at.tangent_W.x();
    feet.tangent_y[i] = foot.at.tangent_W.y();
    feet.curvature_1pm[i] = foot.at.curvature_1pm;
  }
}

}  // namespace

bool FindFeet(const PlanAxis& axis, const AxisPanel& panel, AxisFeet& feet) {
  if (panel.kind == AxisPanel::Kind::kLine)
    OnLine(panel, feet);
  else if (panel.kind == AxisPanel::Kind::kArc) {
    if (!OnArc(panel, feet)) return false;
  } else
    OneByOne(axis, panel, feet);
  return AllWithin(feet.u_m, feet.count, panel.half_m);
}

}  // namespace rodeira::geometry

// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "common/world/surface/crg_build.hpp"

namespace rodeira::surface {
namespace {

// Turns about a centre, then shifts.
void Move(CrgShape& shape, const Eigen::Vector2d& centre, double turn_rad, const Eigen::Vector2d& shift,
          double rise_m) {
  const double cosine = std::cos(turn_rad), sine = std::sin(turn_rad);
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2d& p : shape.line.points_W()) {
    const Eigen::Vector2d from = p - centre;
    points.push_back(centre + shift +
                     Eigen::Vector2d(cosine * from.x() - sine * from.y(), sine * from.x() + cosine * from.y()));
  }
  shape.line = CrgReferenceLine(shape.line.begin_u_m(), shape.line.step_m(), std::move(points));
  for (double& z : shape.line_z_m) z += rise_m;
}

double PointOn(double low, double high, double default_value, const std::optional<double>& given,
               const std::optional<double>& fraction, const std::optional<double>& offset) {
  const double at = given ? *given : (fraction ? low + *fraction * (high - low) : default_value);
  return at + offset.value_or(0.0);
}

}  // namespace

CrgShape PlaceCrgShape(CrgShape shape, const CrgModifiers& m) {
  const bool by_point = m.point_u_m || m.point_u_fraction || m.point_u_offset_m || m.point_v_m || m.point_v_fraction ||
                        m.point_v_offset_m || m.point_x_m || m.point_y_m || m.point_z_m || m.point_heading_rad;
  if (by_point) {
    const CrgReferenceLine& line = shape.line;
    const double u = PointOn(line.begin_u_m(), line.end_u_m(), line.begin_u_m(), m.point_u_m, m.point_u_fraction,
                             m.point_u_offset_m);
    const double v =
        PointOn(shape.v_m.front(), shape.v_m.back(), 0.0, m.point_v_m, m.point_v_fraction, m.point_v_offset_m);
    const Eigen::Vector2d from = line.Position(u, v), direction = line.DirectionAt(u);
    const double turn = m.point_heading_rad.value_or(0.0) - std::atan2(direction.y(), direction.x());
    const Eigen::Vector2d to(m.point_x_m.value_or(0.0), m.point_y_m.value_or(0.0));
    const CrgSurface surface(std::move(shape));
    const CrgPoint at = surface.At(u, v);
    shape = surface.shape();
    Move(shape, from, turn, to - from, m.point_z_m.value_or(0.0) - (at.inside ? at.z_m : 0.0));
  } else if (m.turn_rad || m.shift_x_m || m.shift_y_m || m.shift_z_m) {
    const Eigen::Vector2d begin = shape.line.points_W().front();
    const Eigen::Vector2d centre(m.centre_x_m.value_or(begin.x()), m.centre_y_m.value_or(begin.y()));
    Move(shape, centre, m.turn_rad.value_or(0.0), {m.shift_x_m.value_or(0.0), m.shift_y_m.value_or(0.0)},
         m.shift_z_m.value_or(0.0));
  }
  return shape;
}

}  // namespace rodeira::surface

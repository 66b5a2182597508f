// SPDX-License-Identifier: Apache-2.0
#include "common/editor/offset.hpp"

#include <Eigen/LU>
#include <cmath>

namespace rodeira::editor {

traffic_map::Cubic Beside(const traffic_map::Cubic& curve, double left_m) {
  const auto left_of = [&](double t) -> Eigen::Vector2d {
    const Eigen::Vector2d along = curve.Tangent(t);
    return curve.At(t) + left_m * Eigen::Vector2d(-along.y(), along.x());
  };
  const Eigen::Vector2d begin = left_of(0.0), end = left_of(1.0), head = curve.Tangent(0.0), tail = curve.Tangent(1.0);
  const double old_head = (curve.p_W[1] - curve.p_W[0]).norm(), old_tail = (curve.p_W[3] - curve.p_W[2]).norm();
  // B(1/2) = (p0 + 3 p1 + 3 p2 + p3) / 8 with p1 = begin + a head, p2 = end - b tail.
  Eigen::Matrix2d ways;
  ways << head, -tail;
  const Eigen::Vector2d wanted = (8.0 * left_of(0.5) - 4.0 * begin - 4.0 * end) / 3.0;
  double a = old_head, b = old_tail;
  constexpr double kParallel = 1e-3;
  const double old_chord = (curve.p_W[3] - curve.p_W[0]).norm();
  const double stretched = old_chord > 0.0 ? (end - begin).norm() / old_chord : 1.0;
  a *= stretched, b *= stretched;
  if (std::abs(ways.determinant()) > kParallel) {
    const Eigen::Vector2d solved = ways.inverse() * wanted;
    if (solved.x() > 0.0 && solved.y() > 0.0) a = solved.x(), b = solved.y();
  }
  return {{begin, begin + a * head, end - b * tail, end}};
}

}  // namespace rodeira::editor

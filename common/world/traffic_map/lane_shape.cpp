// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/lane_shape.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::traffic_map {
namespace {

Cubic Mean(const Cubic& a, const Cubic& b) {
  Cubic mean;
  for (std::size_t i = 0; i < mean.p_W.size(); ++i) mean.p_W[i] = 0.5 * (a.p_W[i] + b.p_W[i]);
  return mean;
}

std::array<double, 4> Mean(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  std::array<double, 4> mean{};
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5 * (a[i] + b[i]);
  return mean;
}

// How far to the left of p the border crosses the perpendicular through p: the crossing with the parameter next to t.
double Offset(const Cubic& border, const LanePoint& at) {
  const auto ahead = [&](double u) { return (border.At(u) - at.p_W).dot(at.tangent_W); };
  const auto left = [&](double u) { return (border.At(u) - at.p_W).dot(at.left_W()); };
  constexpr double kStride = 1.0 / 16.0;
  double low = at.parameter, high = at.parameter;  // ahead(low) <= 0 <= ahead(high) once found
  double value = ahead(at.parameter);
  const double direction = value > 0.0 ? -1.0 : 1.0;
  for (double u = at.parameter; value * direction < 0.0;) {
    const double next = std::clamp(u + direction * kStride, 0.0, 1.0);
    if (next == u) {  // the border ends here: straight on
      const Eigen::Vector2d tangent = border.Tangent(u);
      const double along = tangent.dot(at.tangent_W);
      const double further = along > 0.1 ? -value / along : 0.0;
      return left(u) + further * tangent.dot(at.left_W());
    }
    value = ahead(next);
    (direction > 0.0 ? low : high) = u;
    (direction > 0.0 ? high : low) = next;
    u = next;
  }
  double u = 0.5 * (low + high);
  for (int i = 0; i < 60 && high - low > 1e-15; ++i) {  // Newton, held between the bounds
    const double off = ahead(u);
    if (off == 0.0) break;
    (off > 0.0 ? high : low) = u;
    const double rate = border.Slope(u).dot(at.tangent_W);
    const double next = rate > 0.0 ? u - off / rate : low - 1.0;
    const double taken = next > low && next < high ? next : 0.5 * (low + high);
    if (std::abs(taken - u) < 1e-14) break;
    u = taken;
  }
  return left(u);
}

}  // namespace

LaneShape::LaneShape(const Border& left, const Border& right)
    : left_(left),
      right_(right),
      middle_(Mean(left.plan, right.plan)),
      z_m_(Mean(left.z_m, right.z_m)),
      along_(middle_) {}

LanePoint LaneShape::AtParameter(double t) const {
  LanePoint at;
  at.parameter = std::clamp(t, 0.0, 1.0);
  t = at.parameter;
  at.p_W = middle_.At(t);
  at.tangent_W = middle_.Tangent(t);
  at.curvature_1pm = middle_.Curvature(t);
  const double u = 1.0 - t;
  at.z_m = u * u * u * z_m_[0] + 3.0 * u * u * t * z_m_[1] + 3.0 * u * t * t * z_m_[2] + t * t * t * z_m_[3];
  const double rise =
      3.0 * (u * u * (z_m_[1] - z_m_[0]) + 2.0 * u * t * (z_m_[2] - z_m_[1]) + t * t * (z_m_[3] - z_m_[2]));
  const double run = middle_.Slope(t).norm();
  at.grade = run > 0.0 ? rise / run : 0.0;
  at.left_m = Offset(left_.plan, at);
  at.right_m = Offset(right_.plan, at);
  return at;
}

}  // namespace rodeira::traffic_map

// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/cubic.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::traffic_map {
namespace {

// Nodes and weights of the eight-point Gauss-Legendre rule on [-1, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 4> kNodes = {0.183434642495649805, 0.525532409916328986, 0.796666477413626740,
                                          0.960289856497536232};
constexpr std::array<double, 4> kWeights = {0.362683783378361983, 0.313706645877887287, 0.222381034453374471,
                                            0.101228536290376259};
constexpr int kDeepest = 24;  // halvings; only a cusp goes so deep, and only on one side

double Panel(const Cubic& curve, double t0, double t1) {
  const double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0);
  double sum = 0.0;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    sum +=
        kWeights[i] * (curve.Slope(middle - half * kNodes[i]).norm() + curve.Slope(middle + half * kNodes[i]).norm());
  }
  return half * sum;
}

double Refined(const Cubic& curve, double t0, double t1, double whole, double tolerance_m, int depth) {
  const double middle = 0.5 * (t0 + t1);
  const double first = Panel(curve, t0, middle), second = Panel(curve, middle, t1);
  if (std::abs(first + second - whole) <= tolerance_m || depth == kDeepest) return first + second;
  return Refined(curve, t0, middle, first, tolerance_m, depth + 1) +
         Refined(curve, middle, t1, second, tolerance_m, depth + 1);
}

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Eigen::Vector2d Cubic::At(double t) const {
  const double u = 1.0 - t;
  return u * u * u * p_W[0] + 3.0 * u * u * t * p_W[1] + 3.0 * u * t * t * p_W[2] + t * t * t * p_W[3];
}

Eigen::Vector2d Cubic::Slope(double t) const {
  const double u = 1.0 - t;
  return 3.0 * (u * u * (p_W[1] - p_W[0]) + 2.0 * u * t * (p_W[2] - p_W[1]) + t * t * (p_W[3] - p_W[2]));
}

Eigen::Vector2d Cubic::Bend(double t) const {
  return 6.0 * ((1.0 - t) * (p_W[2] - 2.0 * p_W[1] + p_W[0]) + t * (p_W[3] - 2.0 * p_W[2] + p_W[1]));
}

Eigen::Vector2d Cubic::Tangent(double t) const {
  const double small = 1e-9 * PolygonLength();
  const Eigen::Vector2d slope = Slope(t);
  if (slope.norm() > small) return slope.normalized();
  // B'(t ± e) = B' ± e B'' + e²/2 B''': the first one that does not vanish gives the direction.
  const Eigen::Vector2d bend = t < 1.0 ? Bend(t) : Eigen::Vector2d(-Bend(t));
  if (bend.norm() > small) return bend.normalized();
  const Eigen::Vector2d third = p_W[3] - 3.0 * p_W[2] + 3.0 * p_W[1] - p_W[0];
  return third.norm() > small ? Eigen::Vector2d(third.normalized()) : Eigen::Vector2d::UnitX();
}

double Cubic::Curvature(double t) const {
  const double small = 1e-9 * PolygonLength();
  Eigen::Vector2d slope = Slope(t);
  if (slope.norm() <= small) {
    t += t < 0.5 ? 1e-6 : -1e-6;
    slope = Slope(t);
  }
  const double speed = slope.norm();
  return speed <= 0.0 ? 0.0 : Cross(slope, Bend(t)) / (speed * speed * speed);
}

double Cubic::PolygonLength() const {
  return (p_W[1] - p_W[0]).norm() + (p_W[2] - p_W[1]).norm() + (p_W[3] - p_W[2]).norm();
}

double ArcLength(const Cubic& curve, double t0, double t1) {
  return Refined(curve, t0, t1, Panel(curve, t0, t1), 1e-12 * curve.PolygonLength(), 0);
}

ArcTable::ArcTable(const Cubic& curve) : curve_(curve), begin_m_(1, 0.0) {
  for (int i = 0; i < kPanels; ++i) {
    begin_m_.push_back(begin_m_.back() +
                       ArcLength(curve_, static_cast<double>(i) / kPanels, static_cast<double>(i + 1) / kPanels));
  }
}

double ArcTable::DistanceAt(double t) const {
  const double held = std::clamp(t, 0.0, 1.0);
  const int panel = std::min(static_cast<int>(held * kPanels), kPanels - 1);
  return begin_m_[static_cast<std::size_t>(panel)] + ArcLength(curve_, static_cast<double>(panel) / kPanels, held);
}

double ArcTable::ParameterAt(double s_m) const {
  if (s_m <= 0.0 || length_m() <= 0.0) return 0.0;
  if (s_m >= length_m()) return 1.0;
  const auto next = std::upper_bound(begin_m_.begin(), begin_m_.end(), s_m);
  const auto panel = static_cast<std::size_t>(next - begin_m_.begin()) - 1;
  const double begin = static_cast<double>(panel) / kPanels;
  const double wanted = s_m - begin_m_[panel];
  double low = begin, high = static_cast<double>(panel + 1) / kPanels;
  double t = low + (high - low) * wanted / (begin_m_[panel + 1] - begin_m_[panel]);
  for (int i = 0; i < 60 && high - low > 1e-15; ++i) {  // Newton, held between the bounds
    const double off = ArcLength(curve_, begin, t) - wanted;
    if (std::abs(off) <= 1e-12 * length_m()) break;
    (off > 0.0 ? high : low) = t;
    const double speed = curve_.Slope(t).norm();
    const double step = speed > 0.0 ? t - off / speed : low - 1.0;
    t = step > low && step < high ? step : 0.5 * (low + high);
  }
  return t;
}

}  // namespace rodeira::traffic_map

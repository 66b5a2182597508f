// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace rodeira::traffic_map {

// A cubic Bézier curve in plan, B(t) = (1−t)³p0 + 3(1−t)²t p1 + 3(1−t)t² p2 + t³p3, 0 ≤ t ≤ 1; metres.
struct Cubic {
  std::array<Eigen::Vector2d, 4> p_W{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                     Eigen::Vector2d::Zero()};

  // The point at t.
  Eigen::Vector2d At(double t) const;
  Eigen::Vector2d Slope(double t) const;  // dB/dt, m
  Eigen::Vector2d Bend(double t) const;   // d²B/dt², m
  // Unit vector along the curve. Where dB/dt vanishes (control points that coincide at an end) its limit from within;
  // +x where all four points coincide.
  Eigen::Vector2d Tangent(double t) const;
  // Positive to the left, 1/m: (x'y'' − y'x'')/|B'|³. Where dB/dt vanishes, the value a millionth of the curve further
  // in.
  double Curvature(double t) const;
  // The same points, run through from t = 1 to t = 0.
  Cubic Reversed() const { return {{p_W[3], p_W[2], p_W[1], p_W[0]}}; }
  // Sides of the control polygon added up: no part of the curve is longer, m.
  double PolygonLength() const;
};

// ∫|B'|dt from t0 to t1, m, to about 1e-10 of the curve's length: Gauss-Legendre on halves until they agree.
double ArcLength(const Cubic& curve, double t0, double t1);

// Which parameter lies at which distance along the curve.
class ArcTable {
 public:
  explicit ArcTable(const Cubic& curve);

  double length_m() const { return begin_m_.back(); }
  // Both are held within the curve.
  double ParameterAt(double s_m) const;
  double DistanceAt(double t) const;

 private:
  static constexpr int kPanels = 16;  // equal in t

  Cubic curve_;
  std::vector<double> begin_m_;  // one more than panels
};

}  // namespace rodeira::traffic_map

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace rodeira::geometry {

// A point of an axis in plan. The heading is counted from +x towards +y and not wrapped: it adds up along the axis.
struct PlanPoint {
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d tangent_W = Eigen::Vector2d::UnitX();  // (cos, sin) of the heading
  double heading_rad = 0.0;
  double curvature_1pm = 0.0;

  Eigen::Vector2d left_W() const { return {-tangent_W.y(), tangent_W.x()}; }
};

// The point of a panel nearest to a given one: its squared distance, and where, counted from the panel's middle.
struct PanelFoot {
  double squared_m2;
  double u_m;
};

// A short piece of a line, an arc or a clothoid as a power series about its middle, exact to about 1e-13 m, so that a
// point costs no trigonometry: position = middle_W + sum series_W[n] u^(n+1), u in [-half, half].
struct ClothoidPanel {
  static constexpr int kTerms = 12;

  double half_m;
  double heading_rad;  // in the middle
  double curvature_1pm;
  double curvature_rate_1pm2;
  Eigen::Vector2d middle_W;
  std::array<Eigen::Vector2d, kTerms> series_W;
  Eigen::Vector2d begin_W, begin_tangent_W, end_W, end_tangent_W;
  double bulge_m;  // no point of the panel is farther from its chord

  // u_m: from the panel's middle, within [-half, half].
  PlanPoint At(double u_m) const;
  // Position and unit tangent of At alone.
  void Point(double u_m, Eigen::Vector2d& p_W, Eigen::Vector2d& tangent_W) const;
  // Of equally near points the first one.
  PanelFoot Nearest(const Eigen::Vector2d& p_W) const;
};

// Cuts a clothoid of the given length that starts in `start` with its curvature into panels of equal length; the
// curvature changes by rate_1pm2 a metre.
std::vector<ClothoidPanel> CutClothoid(const PlanPoint& start, double rate_1pm2, double length_m);

}  // namespace rodeira::geometry

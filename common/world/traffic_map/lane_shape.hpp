// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/world/traffic_map/cubic.hpp"

namespace rodeira::traffic_map {

// A lane's side, in the direction of its traffic: a cubic in plan, and heights with the same parameter.
struct Border {
  Cubic plan;
  std::array<double, 4> z_m{};
};

// A place along a lane's middle.
struct LanePoint {
  double parameter = 0.0;  // t of the middle's cubic
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d tangent_W = Eigen::Vector2d::UnitX();
  double curvature_1pm = 0.0;  // positive to the left
  double z_m = 0.0;
  double grade = 0.0;  // dz/ds in plan, positive uphill
  // Where the borders cross the perpendicular, positive to the left of the middle: left_m is about half the width,
  // right_m about minus that. A border that ends before the perpendicular is prolonged straight on.
  double left_m = 0.0;
  double right_m = 0.0;

  Eigen::Vector2d left_W() const { return {-tangent_W.y(), tangent_W.x()}; }
  double width_m() const { return left_m - right_m; }
};

// The ground between two borders that run in the direction of the traffic. Its middle is the cubic with control points
// that are the means of the borders' (MOTORS, appendix A.48 with equal weights).
class LaneShape {
 public:
  LaneShape(const Border& left, const Border& right);

  const Border& left() const { return left_; }
  const Border& right() const { return right_; }
  const Cubic& middle() const { return middle_; }
  // Along the middle, in plan.
  double length_m() const { return along_.length_m(); }
  // s is held within [0, length], t within [0, 1].
  LanePoint At(double s_m) const { return AtParameter(along_.ParameterAt(s_m)); }
  // By the parameter t of the middle's cubic.
  LanePoint AtParameter(double t) const;
  // The distance along the middle, m, at its parameter t.
  double DistanceAt(double t) const { return along_.DistanceAt(t); }

 private:
  Border left_;
  Border right_;
  Cubic middle_;
  std::array<double, 4> z_m_;
  ArcTable along_;
};

}  // namespace rodeira::traffic_map

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/core/geometry/clothoid_panel.hpp"
#include "common/core/geometry/near_grid.hpp"

namespace rodeira::geometry {

// One element of an axis in plan: curvature goes linearly from start to end. Equal: an arc; both zero: a line.
struct PlanPiece {
  double length_m = 0.0;             // > 0
  double curvature_start_1pm = 0.0;  // positive to the left
  double curvature_end_1pm = 0.0;
};

// The point of the axis nearest to a given one. t is positive to the left of the axis.
// Beyond an end the foot is that end, t the distance to the left of the axis' prolongation, and beyond_m how far past
// the end the point lies along it: negative before the start, positive after the end, 0 alongside the axis.
struct Foot {
  double s_m = 0.0;
  double t_m = 0.0;
  double beyond_m = 0.0;
  double distance_m = 0.0;
  PlanPoint at;  // the axis at s
};

// A curve in plan made of lines, arcs and clothoids, each starting where the one before ends, in the same direction.
// The pieces are cut into panels of little bend, each a power series exact to about 1e-13 m, so that a point costs no
// trigonometry; where the panels start comes from ClothoidIntegral. Immutable: every answer is a pure function of the
// curve, whatever was asked before.
class PlanCurve {
 public:
  // reach_m: up to this distance Project() answers from a grid (about 0.1 µs), farther away from a tree.
  PlanCurve(Eigen::Vector2d start_W, double heading_rad, std::vector<PlanPiece> pieces, double reach_m = 50.0);

  double length_m() const { return length_m_; }
  const std::vector<PlanPiece>& pieces() const { return pieces_; }
  // s is held within [0, length].
  PlanPoint Evaluate(double s_m) const;
  // The nearest point of the curve, of equally near ones that of the smallest s. Exact (Newton, bracketed), unique
  // while curvature * t < 1 and no other part of the curve is as near.
  Foot Project(double x_m, double y_m) const;
  // False: the point is certainly farther than reach_m from the curve. Much cheaper than Project().
  bool MayReach(double x_m, double y_m) const;
  // The corners of a box that holds the curve.
  const Eigen::Vector2d& low_W() const { return low_W_; }
  const Eigen::Vector2d& high_W() const { return high_W_; }

 private:
  struct Panel : ClothoidPanel {
    double middle_s_m;
  };
  struct Best {
    double squared_m2;
    std::uint32_t panel;
    double u_m;
  };
  struct Box {
    Eigen::Vector2d low, high;
  };
  void CutPiece(const PlanPiece& piece, double start_s_m, const PlanPoint& start);
  void BuildTree();
  void BuildGrid();
  void Nearest(const Eigen::Vector2d& p, std::uint32_t panel, Best& best) const;
  void NearestInTree(const Eigen::Vector2d& p, std::size_t node, std::uint32_t begin, std::uint32_t end,
                     Best& best) const;
  Foot FootAt(const Eigen::Vector2d& p, const Best& best) const;

  std::vector<PlanPiece> pieces_;
  double length_m_ = 0.0;
  double reach_m_;
  Eigen::Vector2d low_W_, high_W_;
  std::vector<Panel> panels_;
  std::vector<double> panel_begin_s_m_;
  std::vector<Box> tree_;  // pre-order over ranges of panels, each range halved
  NearGrid grid_;
};

}  // namespace rodeira::geometry

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace rodeira::surface {

// A place along and across a reference line, with how u and v change in the plane.
struct CrgFoot {
  double u_m = 0.0;
  double v_m = 0.0;                                      // positive to the left
  Eigen::Vector2d u_slope_W = Eigen::Vector2d::UnitX();  // du/d(x, y)
  Eigen::Vector2d v_slope_W = Eigen::Vector2d::UnitY();  // dv/d(x, y)
};

// The reference line of a curved regular grid: a polyline with points every step_m of u. A point at (u, v) lies
// at the distance v beside the segment of u; where two segments meet, the crossing line bisects their corner, and
// between two crossing lines u grows evenly. Beyond its ends the line goes on straight. (ASAM OpenCRG 1.2, evaluation.)
// Every answer is a pure function of the line: there is no history.
class CrgReferenceLine {
 public:
  // At least two points; no segment turns by 90 degrees or more against the one before.
  CrgReferenceLine(double begin_u_m, double step_m, std::vector<Eigen::Vector2d> points_W);

  double begin_u_m() const { return begin_u_m_; }
  double end_u_m() const { return begin_u_m_ + step_m_ * static_cast<double>(points_.size() - 1); }
  double step_m() const { return step_m_; }
  const std::vector<Eigen::Vector2d>& points_W() const { return points_; }

  // The point at (u, v) in the plane, v positive to the left.
  Eigen::Vector2d Position(double u_m, double v_m) const;
  // The way back: the nearest segment, or a neighbour of it, where (x, y) lies on its side of the crossing lines.
  // Unique where v is smaller than the radius of the line's bends.
  CrgFoot Project(double x_m, double y_m) const;
  // The direction of the segment at u.
  Eigen::Vector2d DirectionAt(double u_m) const;

 private:
  struct Box {
    Eigen::Vector2d low, high;
    std::size_t second = 0;  // the second child; the first one follows its parent
    double SquaredDistance(const Eigen::Vector2d& p) const;
  };
  struct Nearest {
    double squared_m2;
    std::size_t segment;
  };
  std::size_t segments() const { return points_.size() - 1; }
  Eigen::Vector2d Along(std::size_t segment) const { return points_[segment + 1] - points_[segment]; }
  // Across the crossing line in a point, in the line's direction.
  Eigen::Vector2d Chord(std::size_t point) const;
  void BuildTree(std::size_t begin, std::size_t end);
  void Search(const Eigen::Vector2d& p, std::size_t node, std::size_t begin, std::size_t end, Nearest& best) const;
  CrgFoot FootBeyond(const Eigen::Vector2d& p, bool at_end) const;

  double begin_u_m_;
  double step_m_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Box> tree_;  // pre-order over ranges of segments, each range halved down to a few segments
  bool straight_ = false;  // all points on one line: any segment answers for all
};

}  // namespace rodeira::surface

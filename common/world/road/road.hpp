// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/geometry/plan_curve.hpp"
#include "common/core/geometry/vertical_profile.hpp"
#include "common/world/road/section.hpp"

namespace rodeira::road {

// The axis of a road at s.
struct RoadFrame {
  double s_m = 0.0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  double heading_rad = 0.0;             // of the direction of growing s, from east to north, in (-pi, pi]
  double grade = 0.0;                   // dz/ds, positive uphill
  double curvature_1pm = 0.0;           // in plan, positive to the left
  double vertical_curvature_1pm = 0.0;  // d2z/ds2, positive in a sag
};

// s along the axis in plan, t across it, positive to the left.
struct RoadCoordinate {
  double s_m = 0.0;
  double t_m = 0.0;
};

enum class MarkColour : std::uint32_t { kWhite = 0, kYellow = 1 };

// A line painted on the road, following it at a constant t.
struct Mark {
  double t_m = 0.0;  // of its middle
  double width_m = 0.1;
  double from_s_m = 0.0;
  double to_s_m = 0.0;
  double stroke_m = 0.0;  // dashed: length of a stroke and of the gap after it, measured along the line itself
  double gap_m = 0.0;     // 0: continuous
  MarkColour colour = MarkColour::kWhite;

  bool dashed() const { return gap_m > 0.0; }
};

// One painted piece of a mark.
struct Stroke {
  double from_s_m = 0.0;
  double to_s_m = 0.0;
};

// What a Road is made from.
struct RoadSpec {
  std::string id;
  Eigen::Vector2d start_W = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
  std::vector<geometry::PlanPiece> pieces;
  std::vector<geometry::GradePoint> grade_points;
  SectionSpec section;
  std::vector<Mark> marks;
};

// A road: an axis in plan, its heights, a cross-section, marks. Immutable; every answer depends on the road alone.
class Road {
 public:
  explicit Road(RoadSpec spec);

  const std::string& id() const { return id_; }
  double length_m() const { return plan_.length_m(); }
  const geometry::PlanCurve& plan() const { return plan_; }
  const geometry::VerticalProfile& profile() const { return profile_; }
  const Section& section() const { return section_; }
  std::span<const Lane> lanes() const { return section_.lanes(); }  // from the rightmost to the leftmost
  std::span<const Mark> marks() const { return marks_; }

  // The axis at s, which is held within [0, length].
  RoadFrame Evaluate(double s_m) const;
  // The point of the road's surface at (s, t), crossfall included; beyond the verge the verge's slope goes on.
  Eigen::Vector3d Position(double s_m, double t_m) const;
  // The exact projection of (x, y) onto the axis: the nearest point, of equally near ones that of the smallest s.
  // Nothing where the nearest point is an end and (x, y) lies beyond it (by more than 1e-9 m). Position(s, t) leads
  // back to (x, y) within 1e-9 m. The height hint will choose between roads over one another; there are none yet.
  std::optional<RoadCoordinate> Locate(double x_m, double y_m, std::optional<double> z_hint_m = std::nullopt) const;
  // t of the lane's middle at s. The lane must be one of this road's.
  double LaneCentre(int lane_id, double s_m) const;
  // The lane at (s, t), or null beside the lanes. On a line between two lanes: the one farther left.
  const Lane* LaneAt(double s_m, double t_m) const;
  // The painted pieces of one of the marks, in ascending s. The dashes are equally long on the line itself, also where
  // it runs on the inner or outer side of a bend.
  std::vector<Stroke> Strokes(const Mark& mark) const;
  // Whether (s, t) is painted; heading_rad is the axis' unwrapped heading at s.
  bool IsPainted(double s_m, double t_m, double heading_rad) const;

 private:
  double AlongMark(const Mark& mark, double s_m, double heading_rad) const;

  std::string id_;
  geometry::PlanCurve plan_;
  geometry::VerticalProfile profile_;
  Section section_;
  std::vector<Mark> marks_;
  std::vector<double> mark_begin_m_;  // AlongMark at each mark's beginning
  double start_heading_rad_;
};

}  // namespace rodeira::road

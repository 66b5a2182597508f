// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
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

// A road as a world file of version 1 says it: an axis in plan, its heights, a cross-section, marks. Reading converts
// it to a road of version 2 (road_network.hpp), which answers all questions afterwards. Immutable.
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

 private:
  std::string id_;
  geometry::PlanCurve plan_;
  geometry::VerticalProfile profile_;
  Section section_;
  std::vector<Mark> marks_;
};

}  // namespace rodeira::road

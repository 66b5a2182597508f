// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/road.hpp"

#include <algorithm>

#include "common/core/geometry/angle.hpp"

namespace rodeira::road {

Road::Road(RoadSpec spec)
    : id_(std::move(spec.id)),
      plan_(spec.start_W, spec.heading_rad, std::move(spec.pieces), Section(spec.section).reach_m() + 1.0),
      profile_(std::move(spec.grade_points)),
      section_(std::move(spec.section)),
      marks_(std::move(spec.marks)) {}

RoadFrame Road::Evaluate(double s_m) const {
  const double s = std::clamp(s_m, 0.0, length_m());
  const geometry::PlanPoint plan = plan_.Evaluate(s);
  const geometry::ProfilePoint profile = profile_.Evaluate(s);
  return {s,
          {plan.p_W.x(), plan.p_W.y(), profile.z_m},
          geometry::WrapAngle(plan.heading_rad),
          profile.grade,
          plan.curvature_1pm,
          profile.curvature_1pm};
}

Eigen::Vector3d Road::Position(double s_m, double t_m) const {
  const double s = std::clamp(s_m, 0.0, length_m());
  const geometry::PlanPoint plan = plan_.Evaluate(s);
  const Eigen::Vector2d p = plan.p_W + t_m * plan.left_W();
  const Band& band = section_.BandAt(t_m);
  return {p.x(), p.y(), profile_.Evaluate(s).z_m + band.from_z_m + band.slope * (t_m - band.from_t_m)};
}

}  // namespace rodeira::road

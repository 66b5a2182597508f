// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/road.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/angle.hpp"

namespace rodeira::road {
namespace {

constexpr double kAtTheEnd_m = 1e-9;

}  // namespace

Road::Road(RoadSpec spec)
    : id_(std::move(spec.id)),
      plan_(spec.start_W, spec.heading_rad, std::move(spec.pieces), Section(spec.section).reach_m() + 1.0),
      profile_(std::move(spec.grade_points)),
      section_(std::move(spec.section)),
      marks_(std::move(spec.marks)),
      start_heading_rad_(spec.heading_rad) {
  for (const Mark& mark : marks_) {
    mark_begin_m_.push_back(AlongMark(mark, mark.from_s_m, plan_.Evaluate(mark.from_s_m).heading_rad));
  }
}

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

std::optional<RoadCoordinate> Road::Locate(double x_m, double y_m, std::optional<double> /*z_hint_m*/) const {
  const geometry::Foot foot = plan_.Project(x_m, y_m);
  if (std::fabs(foot.beyond_m) > kAtTheEnd_m) return std::nullopt;
  return RoadCoordinate{foot.s_m, foot.t_m};
}

double Road::LaneCentre(int lane_id, double /*s_m*/) const {
  const Lane* lane = section_.FindLane(lane_id);
  RODEIRA_ASSERT(lane != nullptr);
  return lane->centre_t_m();
}

const Lane* Road::LaneAt(double /*s_m*/, double t_m) const {
  for (auto lane = lanes().rbegin(); lane != lanes().rend(); ++lane) {
    const double low = std::min(lane->inner_t_m, lane->outer_t_m);
    const double high = std::max(lane->inner_t_m, lane->outer_t_m);
    if (t_m >= low && t_m <= high) return &*lane;
  }
  return nullptr;
}

// The length of a mark from the road's start to s. A line at offset t of an axis with curvature k grows by (1 - k t)
// ds, so its length is s - t (heading(s) - heading(0)).
double Road::AlongMark(const Mark& mark, double s_m, double heading_rad) const {
  return s_m - mark.t_m * (heading_rad - start_heading_rad_);
}

std::vector<Stroke> Road::Strokes(const Mark& mark) const {
  const double end_s = std::min(mark.to_s_m, length_m());
  if (!mark.dashed()) return {{mark.from_s_m, end_s}};
  const auto along = [&](double s) { return AlongMark(mark, s, plan_.Evaluate(s).heading_rad); };
  const double begin = along(mark.from_s_m);
  const double end = along(end_s);
  const auto inverse = [&](double length, double from) {  // the s at which the mark is `length` long; along() grows
    double low = from, high = end_s;
    for (int i = 0; i < 60 && high - low > 1e-9; ++i) {
      const double middle = 0.5 * (low + high);
      (along(middle) < length ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  std::vector<Stroke> strokes;
  double from = mark.from_s_m;
  for (double k = 0.0; begin + k * (mark.stroke_m + mark.gap_m) < end; k += 1.0) {
    const double stroke_begin = begin + k * (mark.stroke_m + mark.gap_m);
    const double stroke_end = stroke_begin + mark.stroke_m;
    from = k == 0.0 ? mark.from_s_m : inverse(stroke_begin, from);
    const double to = stroke_end >= end ? end_s : inverse(stroke_end, from);
    strokes.push_back({from, to});
    from = to;
  }
  return strokes;
}

bool Road::IsPainted(double s_m, double t_m, double heading_rad) const {
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    const Mark& mark = marks_[i];
    if (std::fabs(t_m - mark.t_m) > 0.5 * mark.width_m || s_m < mark.from_s_m || s_m > mark.to_s_m) continue;
    if (!mark.dashed()) return true;
    const double phase = std::fmod(AlongMark(mark, s_m, heading_rad) - mark_begin_m_[i], mark.stroke_m + mark.gap_m);
    if (phase <= mark.stroke_m) return true;
  }
  return false;
}

}  // namespace rodeira::road

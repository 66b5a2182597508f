// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/meeting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/geometry/angle.hpp"

namespace rodeira::network {
namespace {

struct Edges {
  Eigen::Vector3d inner_W, outer_W;
};

Edges EdgesOf(const LaneTip& tip) {
  const double s = tip.s_m();
  const LaneSection& section = tip.road->spec().sections[tip.section];
  const LaneSpan span = *tip.road->SpanAt(tip.section, tip.lane, s);
  return {tip.road->Surface(s, span.inner_t_m, section, span).p_W,
          tip.road->Surface(s, span.outer_t_m, section, span).p_W};
}

}  // namespace

RoadMeeting MeetingOf(const Road& road, End end, const Road& other, End contact) {
  const double s = end == End::kStart ? 0.0 : road.length_m(),
               other_s = contact == End::kStart ? 0.0 : other.length_m();
  const SurfaceSample here = road.Surface(s, 0.0), there = other.Surface(other_s, 0.0);
  const Eigen::Vector3d step = there.p_W - here.p_W;
  const double out = end == End::kEnd ? 1.0 : -1.0, in = contact == End::kStart ? 1.0 : -1.0;
  const double turn = out == in ? 0.0 : geometry::kPi;
  RoadMeeting meeting;
  meeting.gap_m = step.head<2>().norm();
  meeting.step_m = step.z();
  meeting.kink_rad =
      geometry::WrapAngle(other.axis().Evaluate(other_s).heading_rad - road.axis().Evaluate(s).heading_rad + turn);
  const auto grade = [](const Eigen::Vector3d& along_W) { return along_W.z() / along_W.head<2>().norm(); };
  meeting.grade = in * grade(there.ds_W) - out * grade(here.ds_W);
  return meeting;
}

double LaneTip::s_m() const {
  const LaneSection& held = road->spec().sections[section];
  return road->Held(section, end == End::kStart ? held.s_m : held.end_s_m);
}

LaneMeeting MeetingOf(const LaneTip& tip, const LaneTip& other) {
  const Edges here = EdgesOf(tip);
  Edges there = EdgesOf(other);
  // Left is left on both where the roads run the same way; inside may be on either side.
  if ((tip.end == other.end) == ((tip.lane > 0) == (other.lane > 0))) std::swap(there.inner_W, there.outer_W);
  const Eigen::Vector3d inner = there.inner_W - here.inner_W, outer = there.outer_W - here.outer_W;
  return {std::max(inner.head<2>().norm(), outer.head<2>().norm()),
          std::max(std::fabs(inner.z()), std::fabs(outer.z()))};
}

}  // namespace rodeira::network

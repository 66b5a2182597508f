// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/join_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "common/core/geometry/angle.hpp"
#include "common/world/design/axis_reader.hpp"
#include "common/world/network/meeting.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::design {
namespace {

using network::End;
using network::Lane;
using network::LaneSection;
using network::Network;

constexpr double kListed_m = 1e-3;  // less is neither felt nor seen
constexpr double kGrade = 0.005;    // a kink that is felt
constexpr double kAcross_m = 0.05;  // between places across the road that are looked at
constexpr double kLane_m = 0.5;     // a narrower lane is none

double StationOf(const JoinEnd& at) { return at.end == End::kStart ? 0.0 : at.road.length_m(); }
const LaneSection& LaneSectionAt(const JoinEnd& at) {
  return at.end == End::kStart ? at.road.spec().sections.front() : at.road.spec().sections.back();
}
std::uint32_t SectionIndexOf(const JoinEnd& at) {
  return at.end == End::kStart ? 0u : static_cast<std::uint32_t>(at.road.spec().sections.size()) - 1;
}
std::string Named(const JoinEnd& at) { return fmt::format("road '{}' at s = {:.3f} m", at.id, at.s_m); }
double Degrees(double angle_rad) { return angle_rad * 180.0 / geometry::kPi; }

// The largest step between both surfaces, of what is driven on and of all.
struct Step {
  double height_m = 0.0, t_m = 0.0;  // t on the own road
  void Take(double found_m, double at_m) {
    if (found_m > height_m) height_m = found_m, t_m = at_m;
  }
};

struct Steps {
  Step driven, beside;
};

Steps StepsOf(const JoinEnd& own, const JoinEnd& other) {
  const double sign = own.end == other.end ? -1.0 : 1.0, s = StationOf(own), other_s = StationOf(other);
  const LaneSection &section = LaneSectionAt(own), &other_section = LaneSectionAt(other);
  double right, left, other_right, other_left;
  section.Bounds(own.road.spec().lane_offset, s, s, right, left);
  other_section.Bounds(other.road.spec().lane_offset, other_s, other_s, other_right, other_left);
  if (sign < 0.0) other_right = -std::exchange(other_left, -other_right);
  const double from = std::max(right, other_right), to = std::min(left, other_left);
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / kAcross_m)));
  Steps found;
  for (int i = 0; i <= steps && from <= to; ++i) {
    const double t = from + (to - from) * i / steps;
    double outside;
    const network::LaneSpan span = section.At(t, own.road.CentreAt(s), s, outside),
                            other_span = other_section.At(sign * t, other.road.CentreAt(other_s), other_s, outside);
    const double step = std::fabs(own.road.Surface(s, t, section, span).p_W.z() -
                                  other.road.Surface(other_s, sign * t, other_section, other_span).p_W.z());
    const auto driven = [](const network::LaneSpan& on) {
      return on.lane != nullptr && network::IsDrivable(on.lane->type);
    };
    (driven(span) && driven(other_span) ? found.driven : found.beside).Take(step, t);
  }
  return found;
}

}  // namespace

bool CheckJoin(const config::Map& link, const JoinEnd& own, const JoinEnd& other, std::vector<std::string>& warnings) {
  const network::RoadMeeting meeting = network::MeetingOf(own.road, own.end, other.road, other.end);
  const auto refuse = [&](std::string message) {
    link.Problem("road", std::move(message));
    return false;
  };
  const auto warn = [&](std::string message) { warnings.push_back(link.Place("road") + ": " + std::move(message)); };
  if (meeting.gap_m > Network::kClosed_m) {
    return refuse(
        fmt::format("the ends of the roads '{}' and '{}' are {:.3f} m apart in plan; at most {} m was expected", own.id,
                    other.id, meeting.gap_m, Network::kClosed_m));
  }
  if (std::fabs(meeting.step_m) > Network::kClosed_m) {
    return refuse(fmt::format("{} is {:.3f} m {} than {}; at most {} m was expected", Named(other),
                              std::fabs(meeting.step_m), meeting.step_m > 0.0 ? "higher" : "lower", Named(own),
                              Network::kClosed_m));
  }
  if (std::fabs(meeting.kink_rad) > kMaxKink_rad) {
    return refuse(
        fmt::format("{} and {} meet with a kink of {:.3f} degrees to the {}; at most {:.3f} degrees was expected",
                    Named(own), Named(other), std::fabs(Degrees(meeting.kink_rad)),
                    meeting.kink_rad > 0.0 ? "left" : "right", Degrees(kMaxKink_rad)));
  }
  const int sign = own.end == other.end ? -1 : 1;
  for (const auto* side : {&LaneSectionAt(own).left, &LaneSectionAt(own).right}) {
    for (const Lane& lane : *side) {
      if (!network::IsDrivable(lane.type)) continue;
      const double width = own.road.SpanAt(SectionIndexOf(own), lane.id, StationOf(own))->width_m();
      const Lane* beyond = LaneSectionAt(other).Find(sign * lane.id);
      if (beyond == nullptr || !network::IsDrivable(beyond->type)) {
        if (width > kLane_m)
          warn(fmt::format("lane {} of {}, {:.2f} m wide, ends there: road '{}' has no lane {} to drive on", lane.id,
                           Named(own), width, other.id, sign * lane.id));
        continue;
      }
      const network::LaneMeeting edges =
          network::MeetingOf({&own.road, SectionIndexOf(own), lane.id, own.end},
                             {&other.road, SectionIndexOf(other), beyond->id, other.end});
      const std::string said = fmt::format("the edges of lane {} of {} and of lane {} of {} are up to {:.3f} m apart",
                                           lane.id, Named(own), beyond->id, Named(other), edges.gap_m);
      if (edges.gap_m > Network::kClosed_m)
        return refuse(fmt::format("{}; at most {} m was expected", said, Network::kClosed_m));
      if (edges.gap_m > kListed_m) warn(said);
    }
  }
  for (const auto* side : {&LaneSectionAt(other).left, &LaneSectionAt(other).right}) {
    for (const Lane& lane : *side) {
      const Lane* before = LaneSectionAt(own).Find(sign * lane.id);
      const double width = other.road.SpanAt(SectionIndexOf(other), lane.id, StationOf(other))->width_m();
      if (!network::IsDrivable(lane.type) || (before != nullptr && network::IsDrivable(before->type)) ||
          !(width > kLane_m))
        continue;
      warn(fmt::format("lane {} of {}, {:.2f} m wide, ends there: road '{}' has no lane {} to drive on", lane.id,
                       Named(other), width, own.id, sign * lane.id));
    }
  }
  const Steps steps = StepsOf(own, other);
  const auto step = [&](const Step& found) {
    return fmt::format("a step of {:.3f} m in the road's surface between {} and {}, {:.2f} m to the {}", found.height_m,
                       Named(own), Named(other), std::fabs(found.t_m), found.t_m < 0.0 ? "right" : "left");
  };
  if (steps.driven.height_m > Network::kClosed_m)
    return refuse(fmt::format("{}; at most {} m was expected", step(steps.driven), Network::kClosed_m));
  if (steps.driven.height_m > kListed_m) warn(step(steps.driven));
  if (steps.beside.height_m > Network::kClosed_m) warn(step(steps.beside) + " (beside what is driven on)");
  if (std::fabs(meeting.grade) > kGrade)
    warn(fmt::format("{} and {} meet with a kink of {:.2f} % in their grade", Named(own), Named(other),
                     100.0 * meeting.grade));
  return true;
}

}  // namespace rodeira::design

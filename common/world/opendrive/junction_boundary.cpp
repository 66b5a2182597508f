// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/junction_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/suggest.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::opendrive {
namespace {

using network::Road;
using Points = std::vector<Eigen::Vector2d>;

constexpr double kEdgeStep_m = 0.5;           // between points along a lane's edge
constexpr double kBoundaryRounding_m = 1e-6;  // no gap

// A segment as it lies in the plane; of one across a road's end where on the road its two points are.
struct Drawn {
  const BoundarySegment* segment;
  const Road* road;
  Points points_W;
  double s_m = 0.0, first_t_m = 0.0, last_t_m = 0.0;
};

class Drawer {
 public:
  Drawer(const JunctionReading& junction, std::span<const Road> roads, const Tolerance& tolerance, Findings& findings)
      : junction_(junction),
        roads_(roads),
        tolerance_(tolerance),
        findings_(findings),
        errors_before_(findings.errors.size()) {}

  JunctionBoundary Draw() {
    for (const BoundarySegment& segment : junction_.boundary) Add(segment);
    JunctionBoundary boundary;
    if (!good()) return boundary;
    for (std::size_t i = 0; i < drawn_.size(); ++i) Meet(drawn_[i], drawn_[(i + 1) % drawn_.size()]);
    for (const Drawn& drawn : drawn_)
      boundary.corners_W.insert(boundary.corners_W.end(), drawn.points_W.begin(), drawn.points_W.end());
    double twice_area = 0.0;
    for (std::size_t i = 0; i < boundary.corners_W.size(); ++i) {
      twice_area += geometry::Cross(boundary.corners_W[i], boundary.corners_W[(i + 1) % boundary.corners_W.size()]);
    }
    if (good() && !(twice_area > 0.0))
      Wrong(junction_.line, "junctions.boundary.segments_counter_clockwise_order",
            "the boundary's segments do not go round counter-clockwise");
    if (!good()) return {};
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      if (drawn_[i].segment->joint && drawn_[i].segment->transition_m > 0.0) boundary.mouths.push_back(MouthAt(i));
    }
    return boundary;
  }

 private:
  bool good() const { return findings_.errors.size() == errors_before_; }

  void Wrong(std::size_t line, std::string rule, std::string message) {
    findings_.errors.push_back({std::move(rule),
                                fmt::format("junction {}: {}", junction_.junction.id, message),
                                line,
                                "",
                                {},
                                {},
                                {RepairKind::kGridIgnored, "its roads keep their own heights"}});
  }

  void Add(const BoundarySegment& segment) {
    const auto road = std::find_if(roads_.begin(), roads_.end(), [&](const Road& r) { return r.id() == segment.road; });
    if (road == roads_.end()) {
      std::vector<std::string> names;
      for (const Road& known : roads_) names.push_back(known.id());
      Wrong(segment.line, "junctions.boundary.road",
            fmt::format("its boundary names the road '{}', which is not in the file{}", segment.road,
                        base::DidYouMean(segment.road, names)));
      return;
    }
    drawn_.push_back({&segment, &*road, {}});
    if (segment.joint)
      DrawAcross(segment, drawn_.back());
    else
      DrawAlong(segment, drawn_.back());
  }

  // The outer edge of a lane, t; nothing, and a finding, where there is no such lane.
  std::optional<double> EdgeAt(const BoundarySegment& segment, const Road& road, int lane, double s_m) {
    if (lane == 0) return road.CentreAt(s_m).value;
    const auto span = road.SpanAt(road.SectionIndex(s_m), lane, s_m);
    if (!span) {
      Wrong(segment.line, "junctions.boundary.lane",
            fmt::format("its boundary names lane {} of road {}, which is not there at s {:.6g}", lane, road.id(), s_m));
      return std::nullopt;
    }
    return span->outer_t_m;
  }

  void DrawAlong(const BoundarySegment& segment, Drawn& drawn) {
    const Road& road = *drawn.road;
    const double from = std::clamp(segment.from_s_m, 0.0, road.length_m()),
                 to = std::clamp(segment.to_s_m, 0.0, road.length_m());
    const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(to - from) / kEdgeStep_m)));
    for (int i = 0; i <= steps; ++i) {
      const double s = i == steps ? to : from + (to - from) * i / steps;
      const auto t = EdgeAt(segment, road, segment.lane, s);
      if (!t) return;
      drawn.points_W.push_back(road.Surface(s, *t).p_W.head<2>());
    }
  }

  // Looking out of the junction it goes from right to left; without lanes said, past all of them.
  void DrawAcross(const BoundarySegment& segment, Drawn& drawn) {
    const Road& road = *drawn.road;
    const bool starts = segment.end == network::End::kStart;
    drawn.s_m = starts ? 0.0 : road.length_m();
    const network::LaneSection& section = road.SectionAt(drawn.s_m);
    const int right = -static_cast<int>(section.right.size()), left = static_cast<int>(section.left.size());
    const auto first = EdgeAt(segment, road, segment.first_lane.value_or(starts ? right : left), drawn.s_m);
    const auto last = EdgeAt(segment, road, segment.last_lane.value_or(starts ? left : right), drawn.s_m);
    if (!first || !last) return;
    drawn.first_t_m = *first, drawn.last_t_m = *last;
    for (const double t : {*first, *last}) drawn.points_W.push_back(road.Surface(drawn.s_m, t).p_W.head<2>());
  }

  void Meet(const Drawn& one, const Drawn& next) {
    const double gap = (one.points_W.back() - next.points_W.front()).norm();
    if (gap <= kBoundaryRounding_m) return;
    std::string message = fmt::format("a gap of {:.4g} m in its boundary before the segment on road {}; {}", gap,
                                      next.road->id(), GapWords(gap, tolerance_.gap_m, Tolerance::Strict().gap_m, "m"));
    if (gap > tolerance_.gap_m) {
      Wrong(next.segment->line, "junctions.boundary.segments_close_boundry", std::move(message));
      return;
    }
    findings_.warnings.push_back({"junctions.boundary.segments_close_boundry",
                                  fmt::format("junction {}: {}", junction_.junction.id, message),
                                  next.segment->line,
                                  "",
                                  {},
                                  {}});
  }

  // The point a distance along the lanes' edges that follow a segment, or that come before it.
  Eigen::Vector2d Along(std::size_t index, bool forward, double distance_m) const {
    const std::size_t count = drawn_.size();
    const Points& across = drawn_[index].points_W;
    Eigen::Vector2d at = forward ? across.back() : across.front();
    for (std::size_t k = 1; k < count; ++k) {
      const Drawn& drawn = drawn_[(index + (forward ? k : count - k)) % count];
      if (drawn.segment->joint) return at;
      for (std::size_t i = 0; i < drawn.points_W.size(); ++i) {
        const Eigen::Vector2d& next = drawn.points_W[forward ? i : drawn.points_W.size() - 1 - i];
        const double step = (next - at).norm();
        if (step >= distance_m && step > 0.0) return at + distance_m / step * (next - at);
        distance_m -= step;
        at = next;
      }
    }
    return at;
  }

  network::JunctionMouth MouthAt(std::size_t index) const {
    const Drawn& drawn = drawn_[index];
    network::JunctionMouth mouth{std::make_shared<Road>(*drawn.road), drawn.s_m, drawn.first_t_m, drawn.last_t_m,
                                 drawn.points_W};
    mouth.corners_W.push_back(Along(index, true, drawn.segment->transition_m));
    mouth.corners_W.push_back(Along(index, false, drawn.segment->transition_m));
    return mouth;
  }

  const JunctionReading& junction_;
  std::span<const Road> roads_;
  const Tolerance& tolerance_;
  Findings& findings_;
  std::size_t errors_before_;
  std::vector<Drawn> drawn_;
};

}  // namespace

JunctionBoundary BoundaryOf(const JunctionReading& junction, std::span<const Road> roads, const Tolerance& tolerance,
                            Findings& findings) {
  if (junction.boundary.empty()) return {};
  return Drawer(junction, roads, tolerance, findings).Draw();
}

}  // namespace rodeira::opendrive

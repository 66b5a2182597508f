// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/junction_arms.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"
#include "common/world/design/section_reader.hpp"

namespace rodeira::design {
namespace {

// Half the width of a road at a station, on its wider side.
double HalfWidth(const network::Road& road, double s_m) {
  const auto& section = road.spec().sections[0];
  const double left = EdgeOf(road.spec(), static_cast<int>(section.left.size())).Value(s_m);
  const double right = EdgeOf(road.spec(), -static_cast<int>(section.right.size())).Value(s_m);
  return std::max(std::fabs(left), std::fabs(right));
}

}  // namespace

std::vector<Setback> Setbacks(const JunctionSpec& junction, const std::vector<network::Road>& roads) {
  std::vector<Setback> setbacks(junction.meetings.size());
  for (std::size_t i = 0; i < junction.meetings.size(); ++i) {
    const Meeting& own = junction.meetings[i];
    const double half = HalfWidth(roads[own.road], own.s_m);
    const Eigen::Vector2d along = roads[own.road].axis().Evaluate(own.s_m).tangent_W;
    for (std::size_t k = 0; k < junction.meetings.size(); ++k) {
      if (k == i) continue;
      const Meeting& other = junction.meetings[k];
      const double other_half = HalfWidth(roads[other.road], other.s_m);
      const Eigen::Vector2d across = roads[other.road].axis().Evaluate(other.s_m).tangent_W;
      const double sine = std::fabs(geometry::Cross(along, across));
      // The edges of the two roads meet this far along the own one where the angle between them is the acute one.
      const double blunt = other_half / sine + junction.radius_m;
      for (const bool before : {true, false}) {
        if (!(before ? own.before : own.after)) continue;
        double reach = blunt;
        for (const bool other_before : {true, false}) {
          if (!(other_before ? other.before : other.after)) continue;
          const double cosine = (before ? -along : along).dot(other_before ? -across : across);
          if (cosine > 0.0) reach = std::max(reach, (other_half + half * cosine) / sine + junction.radius_m);
        }
        double& setback = before ? setbacks[i].before_m : setbacks[i].after_m;
        setback = std::max(setback, reach);
      }
    }
  }
  return setbacks;
}

Eigen::Vector2d Outward(const network::Road& road, network::End end) {
  const bool starts = end == network::End::kStart;
  const Eigen::Vector2d along = road.axis().Evaluate(starts ? 0.0 : road.length_m()).tangent_W;
  return starts ? along : Eigen::Vector2d(-along);
}

std::vector<ArmLane> LanesOf(const network::Road& road, network::End end, bool incoming) {
  const bool starts = end == network::End::kStart;
  const double s = starts ? 0.0 : road.length_m();
  const auto& section = starts ? road.spec().sections.front() : road.spec().sections.back();
  const int wanted = incoming == starts ? -1 : 1;  // of traffic along s
  std::vector<ArmLane> lanes;
  const auto add = [&](const network::Lane& lane) {
    if (!network::IsDrivable(lane.type) || (lane.direction != wanted && lane.direction != 0)) return;
    const network::LaneSpan span = *section.Span(lane.id, road.CentreAt(s), s);
    if (span.width_m() < 1.5) return;
    const double high = std::max(span.inner_t_m, span.outer_t_m), low = std::min(span.inner_t_m, span.outer_t_m);
    const auto at = [&](double t) { return Eigen::Vector2d(road.Surface(s, t, section, span).p_W.head<2>()); };
    lanes.push_back({lane.id, at(wanted > 0 ? high : low), at(wanted > 0 ? low : high), span.width_m()});
  };
  for (std::size_t i = section.left.size(); i-- > 0;) add(section.left[i]);
  for (const network::Lane& lane : section.right) add(lane);
  if (wanted < 0) std::reverse(lanes.begin(), lanes.end());
  return lanes;
}

}  // namespace rodeira::design

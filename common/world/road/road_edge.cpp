// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/road_edge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/core/geometry/plane.hpp"
#include "common/world/network/settle.hpp"

namespace rodeira::road {
namespace {

constexpr double kSteeper = 0.8;  // of the reach
constexpr int kSamples = 16;      // of a panel's edges
constexpr double kMinPace = 0.05;

// How far the edges lie from the axis.
double WidestOf(const network::Road& road) {
  double widest = 0.0;
  for (const network::LaneSection& section : road.spec().sections) {
    double right, left;
    section.Bounds(road.spec().lane_offset, section.s_m, section.end_s_m, right, left);
    widest = std::max({widest, -right, left});
  }
  return widest;
}

bool HasLevelLanes(const network::Road& road) {
  const auto level = [](const network::Lane& lane) { return lane.level; };
  const auto& sections = road.spec().sections;
  return std::any_of(sections.begin(), sections.end(), [&](const network::LaneSection& section) {
    return std::any_of(section.left.begin(), section.left.end(), level) ||
           std::any_of(section.right.begin(), section.right.end(), level);
  });
}

bool IsConstant(const geometry::CubicTable& table) {
  const auto& records = table.records();
  return std::all_of(records.begin(), records.end(), [&](const geometry::Cubic& one) {
    return one.b == 0.0 && one.c == 0.0 && one.d == 0.0 && one.a == records.front().a;
  });
}

network::LaneSpan SpanAt(const network::LaneSection& section, const SteadyEdges& steady, double t_m,
                         const geometry::CubicPoint& centre, double s_m, double& outside_m) {
  if (steady.section == &section) {
    if (const network::LaneSpan* beyond = steady.Beyond(t_m, outside_m)) return *beyond;
  }
  return section.At(t_m, centre, s_m, outside_m);
}

}  // namespace

const network::LaneSpan* SteadyEdges::Beyond(double t_m, double& outside_m) const {
  if (t_m >= centre_t_m && t_m > left_t_m) {
    outside_m = t_m - left_t_m;
    return &left;
  }
  if (t_m < centre_t_m && t_m < right_t_m) {
    outside_m = right_t_m - t_m;
    return &right;
  }
  return nullptr;
}

SteadyEdges SteadyEdgesOf(const network::Road& road, const Stretch& stretch) {
  constexpr double kFar_m = 1e6;
  const network::LaneSection& section = road.SectionAt(stretch.from_s_m);
  if (&section != &road.SectionAt(stretch.to_s_m) || !IsConstant(road.spec().lane_offset)) return {};
  for (const auto* lanes : {&section.left, &section.right}) {
    for (const network::Lane& lane : *lanes) {
      if (lane.bordered() || !IsConstant(lane.width) ||
          (!lane.width.records().empty() && lane.width.records().front().a < 0.0))
        return {};
    }
  }
  SteadyEdges steady;
  const geometry::CubicPoint centre = road.CentreAt(stretch.from_s_m);
  double outside;
  steady.section = &section, steady.centre_t_m = centre.value;
  steady.left = section.At(kFar_m, centre, stretch.from_s_m, outside),
  steady.right = section.At(-kFar_m, centre, stretch.from_s_m, outside);
  steady.left_t_m = section.left.empty() ? centre.value : steady.left.outer_t_m,
  steady.right_t_m = section.right.empty() ? centre.value : steady.right.outer_t_m;
  return steady;
}

std::pair<double, double> Steepening(double distance_m, double reach_m) {
  if (distance_m <= kSteeper * reach_m) return {0.0, 0.0};
  const double x = (distance_m / reach_m - kSteeper) / (1.0 - kSteeper);
  const double left = std::max(1.0 - x, 1e-9);
  return {reach_m * x * x / left, x * (2.0 - x) / (left * left) / (1.0 - kSteeper)};
}

EdgesAside EdgesBeside(const network::Road& road, const geometry::AxisPanel& panel) {
  if (road.rolled() && HasLevelLanes(road)) {  // what stays level goes on from where the leaning part ends
    const double beside = road.axis().Bulge(panel) + 2.0 * WidestOf(road) + 1.0;
    return {beside, beside, beside};
  }
  double most_right = 0.0, most_left = 0.0;
  const std::vector<network::LaneSection>& sections = road.spec().sections;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const double from = i == 0 ? panel.begin_s_m() : std::max(panel.begin_s_m(), sections[i].s_m);
    const double to = i + 1 == sections.size() ? panel.end_s_m() : std::min(panel.end_s_m(), sections[i].end_s_m);
    if (from > to) continue;
    double right, left;
    sections[i].Bounds(road.spec().lane_offset, from, to, right, left);
    most_right = std::max({most_right, -right, -left}), most_left = std::max({most_left, right, left});
  }
  const double more = road.axis().Bulge(panel) + kSampleMargin_m, most = std::max(most_right, most_left);
  // Seen from above a leaning section is shorter than t, and does not stand square to the axis.
  if (road.rolled()) return {most + more, most + more, most + more};
  return {most + more, most_right + more, most_left + more};
}

EdgeHeights HeightsOfEdges(const network::Road& road, double from_s_m, double to_s_m) {
  double low = std::numeric_limits<double>::infinity(), high = -low,
         most = 0.0;  // the greatest step between two samples
  std::array<double, 2> last{};
  for (int k = 0; k <= kSamples; ++k) {
    const double s = from_s_m + (to_s_m - from_s_m) * k / kSamples;
    double right, left;
    road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
    const std::array<double, 2> z = {road.Surface(s, right).p_W.z(), road.Surface(s, left).p_W.z()};
    for (std::size_t side = 0; side < 2; ++side) {
      low = std::min(low, z[side]), high = std::max(high, z[side]);
      if (k > 0) most = std::max(most, std::fabs(z[side] - last[side]));
    }
    last = z;
  }
  return {low - most - kSampleMargin_m, high + most + kSampleMargin_m};
}

EdgePlace PlaceOnEdge(const network::Road& road, const geometry::AxisPanel& panel, const Stretch& stretch,
                      const Eigen::Vector2d& p_W, const SteadyEdges& steady) {
  const geometry::AxisFoot foot = road.axis().Foot(panel, p_W);
  const double found = panel.middle_s_m + foot.u_m;
  EdgePlace place;
  place.found_s_m = found, place.found_t_m = foot.t_m, place.beyond_m = foot.beyond_m;
  double s = std::clamp(found, stretch.from_s_m, stretch.to_s_m);
  place.beside = s == found && foot.beyond_m == 0.0;
  // On a rolled road t runs along a slope: its edges are nearer to the axis than they are wide.
  if (road.rolled()) (void)network::SettleOn(road, &panel, p_W, stretch.from_s_m, stretch.to_s_m, s, place.found_t_m);
  const network::LaneSection& section = road.SectionAt(s);
  const geometry::CubicPoint centre = road.CentreAt(s);
  network::LaneSpan span = SpanAt(section, steady, place.found_t_m, centre, s, place.outside_m);
  place.t_m = place.found_t_m + (place.found_t_m > centre.value ? -place.outside_m : place.outside_m);
  if (road.rolled() && place.outside_m > 0.0) {  // the section leans: the nearest point of its edge lies elsewhere
    network::MoveAlongEdge(road, &panel, p_W, stretch.from_s_m, stretch.to_s_m, place.t_m, s);
    double outside_there;
    span = section.At(place.t_m, road.CentreAt(s), s, outside_there);
  }
  place.s_m = s;
  place.t_slope = place.outside_m > 0.0 ? span.outer_slope : 0.0;
  place.axis = s == found ? foot.at : road.axis().At(panel, s - panel.middle_s_m);
  place.sample = road.Surface(place.axis, s, place.t_m, section, span);
  if (place.beside) {
    const double pace =
        place.sample.ds_W.head<2>().norm() -
        place.axis.curvature_1pm * geometry::Cross(place.axis.tangent_W, p_W - place.sample.p_W.head<2>());
    if (pace > kMinPace) place.pace = pace;
  }
  return place;
}

EdgePlace MovedTo(double s_m, const network::Road& road, const geometry::AxisPanel& panel, const EdgePlace& place,
                  const SteadyEdges& steady) {
  EdgePlace moved = place;
  moved.s_m = s_m;
  const network::LaneSection& section = road.SectionAt(s_m);
  const geometry::CubicPoint centre = road.CentreAt(s_m);
  const network::LaneSpan span = SpanAt(section, steady, place.found_t_m, centre, s_m, moved.outside_m);
  moved.t_m = place.found_t_m + (place.found_t_m > centre.value ? -moved.outside_m : moved.outside_m);
  moved.t_slope = moved.outside_m > 0.0 ? span.outer_slope : 0.0;
  moved.axis = road.axis().At(panel, s_m - panel.middle_s_m);
  moved.sample = road.Surface(moved.axis, s_m, moved.t_m, section, span);
  return moved;
}

}  // namespace rodeira::road

// SPDX-License-Identifier: Apache-2.0
// What Surfaces says of a point, for many that lie close together: the band, the section and the records of all tables
// are looked up once, then each step of the same formulas is made for all points.
#include "common/world/network/cluster.hpp"

#include <algorithm>
#include <cmath>

#include "common/world/network/cluster_band.hpp"
#include "common/world/network/cluster_lean.hpp"
#include "common/world/network/in_force.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::network {
namespace {

using Numbers = Cluster::Numbers;

bool AllOnEarth(const Numbers& coordinates_m, std::size_t count) {
  return All(count, [&](std::size_t i) { return std::fabs(coordinates_m[i]) < Network::kFarthest_m; });  // not NaN
}

bool IsConstant(const Lane& lane, const Cluster& cluster) {
  const InForce width(lane.width, cluster), border(lane.border, cluster);
  return width.common() && width.constant() && border.common() && border.constant();
}

// A lane with heights of its own is left to Road::Surface.
bool IsPlain(const LaneSpan& span) { return span.lane != nullptr && !span.lane->level && span.lane->heights.empty(); }

// The lanes that hold the points. False where one is beside all lanes, or on a lane that is not plain.
bool FindLanes(const Road& road, const LaneSection& section, Cluster& cluster) {
  double outside;
  const auto plain = [&](double s, double t, int& lane) {
    const LaneSpan span = section.At(t, road.CentreAt(s), s, outside);
    if (outside > 0.0 || !IsPlain(span)) return false;
    lane = span.lane->id;
    return true;
  };
  int rightmost, leftmost;
  if (!plain(cluster.low_s_m, cluster.low_t_m, rightmost) || !plain(cluster.high_s_m, cluster.high_t_m, leftmost))
    return false;
  const auto constant = [&](const Lane& lane) { return IsConstant(lane, cluster); };
  const InForce centre(road.spec().lane_offset, cluster);
  if (rightmost == leftmost && centre.common() && centre.constant() &&
      std::all_of(section.left.begin(), section.left.end(), constant) &&
      std::all_of(section.right.begin(), section.right.end(), constant)) {
    cluster.lane = rightmost;  // the lanes' edges stand still: what lies between the outermost points is on it too
    return true;
  }
  cluster.lane = 0;
  for (std::size_t i = 0; i < cluster.feet.count; ++i) {
    if (!plain(cluster.s_m[i], cluster.feet.t_m[i], cluster.lanes[i])) return false;
  }
  return true;
}

// The lateral profile's part of the surface.
struct Heights {
  Numbers z, by_s, by_t;
};

void OneByOne(const LateralProfile& profile, const Cluster& cluster, Heights& heights) {
  for (std::size_t i = 0; i < cluster.feet.count; ++i) {
    const LateralPoint point = profile.At(cluster.s_m[i], cluster.feet.t_m[i]);
    heights.z[i] = point.z_m;
    heights.by_s[i] = point.slope_s;
    heights.by_t[i] = point.slope_t;
  }
}

// Height of a strip at u outward, and its derivatives by s (at fixed u) and by u. False where a record ends among the
// points.
bool EvaluateStrip(const SurfaceStrip& strip, const Cluster& cluster, const Numbers& u, Heights& heights) {
  const std::size_t count = cluster.feet.count;
  Numbers value, slope;
  std::fill_n(heights.z.begin(), count, 0.0);
  std::fill_n(heights.by_s.begin(), count, 0.0);
  std::fill_n(heights.by_t.begin(), count, 0.0);
  const auto add = [&](std::size_t n, const auto& power, const auto& power_slope) {
    if (strip.coefficients[n].empty()) return true;
    const InForce record(strip.coefficients[n], cluster);
    record.Evaluate(cluster, value, slope);
    for (std::size_t i = 0; i < count; ++i) {
      heights.z[i] += value[i] * power(u[i]);
      heights.by_s[i] += slope[i] * power(u[i]);
      heights.by_t[i] += value[i] * power_slope(u[i]);
    }
    return record.common();
  };
  return add(
             0, [](double) { return 1.0; }, [](double) { return 0.0; }) &&
         add(
             1, [](double x) { return x; }, [](double) { return 1.0; }) &&
         add(
             2, [](double x) { return x * x; }, [](double x) { return 2.0 * x; }) &&
         add(
             3, [](double x) { return x * x * x; }, [](double x) { return 3.0 * x * x; });
}

// The strips of one side. False where the points lie on more than one of them, or a record ends among them.
bool EvaluateStrips(const CrossSectionSurface& surface, const Cluster& cluster, Heights& heights) {
  const std::size_t count = cluster.feet.count;
  const InForce offset_record(surface.t_offset, cluster);
  if (!offset_record.common()) return false;
  Numbers offset, offset_slope, u, u_slope, base_z, base_by_s, width, width_slope;
  offset_record.Evaluate(cluster, offset, offset_slope);
  const bool is_left = cluster.feet.t_m[0] >= offset[0];
  for (std::size_t i = 0; i < count; ++i) {
    if ((cluster.feet.t_m[i] >= offset[i]) != is_left) return false;
  }
  const double sign = is_left ? 1.0 : -1.0;
  for (std::size_t i = 0; i < count; ++i) {
    u[i] = sign * (cluster.feet.t_m[i] - offset[i]);
    u_slope[i] = -sign * offset_slope[i];
    base_z[i] = base_by_s[i] = 0.0;
  }
  const std::vector<SurfaceStrip>& strips = is_left ? surface.left : surface.right;
  for (std::size_t k = 0; k < strips.size(); ++k) {
    const SurfaceStrip& strip = strips[k];
    std::fill_n(width.begin(), count, 0.0);
    std::fill_n(width_slope.begin(), count, 0.0);
    if (strip.has_width) {
      const InForce record(strip.width, cluster);
      if (!record.common()) return false;
      record.Evaluate(cluster, width, width_slope);
    }
    const auto holds = [&](std::size_t i) { return !strip.has_width || u[i] <= width[i] || k + 1 == strips.size(); };
    const bool here = holds(0);
    for (std::size_t i = 0; i < count; ++i) {
      if (holds(i) != here) return false;
    }
    if (!EvaluateStrip(strip, cluster, here ? u : width, heights)) return false;
    const Numbers& moved = here ? u_slope : width_slope;
    for (std::size_t i = 0; i < count; ++i) heights.by_s[i] += heights.by_t[i] * moved[i];
    if (strip.relative) {
      for (std::size_t i = 0; i < count; ++i) {
        heights.z[i] += base_z[i];
        heights.by_s[i] += base_by_s[i];
      }
    }
    if (here) {
      for (std::size_t i = 0; i < count; ++i) heights.by_t[i] *= sign;
      return true;
    }
    for (std::size_t i = 0; i < count; ++i) {
      base_z[i] = heights.z[i];
      base_by_s[i] = heights.by_s[i];
      u[i] -= width[i];
      u_slope[i] -= width_slope[i];
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    heights.z[i] = base_z[i], heights.by_s[i] = base_by_s[i], heights.by_t[i] = 0.0;
  return true;
}

void SetLateral(const LateralProfile& profile, const Cluster& cluster, Heights& heights) {
  const bool strips_alone = profile.shapes.empty() && profile.crossfall_left.empty() &&
                            profile.crossfall_right.empty() &&
                            (!profile.surface.left.empty() || !profile.surface.right.empty());
  if (profile.flat())
    heights.z = heights.by_s = heights.by_t = {};
  else if (!strips_alone || !EvaluateStrips(profile.surface, cluster, heights))
    OneByOne(profile, cluster, heights);
  for (std::size_t i = 0; i < cluster.feet.count; ++i) {  // both add up their parts from 0, so that a -0 becomes 0
    heights.z[i] = 0.0 + heights.z[i];
    heights.by_s[i] = 0.0 + (heights.by_s[i] + heights.by_t[i] * 0.0);
    heights.by_t[i] = 0.0 + heights.by_t[i];
  }
}

// As Road::Surface. leans: of the sections, where they lean.
bool SetSurface(const Road& road, const ClusterLeans& leans, Cluster& cluster) {
  const InForce elevation(road.spec().elevation, cluster);
  if (!elevation.common()) return false;
  elevation.Evaluate(cluster, cluster.z_m, cluster.z_by_s);
  Heights heights;
  SetLateral(road.spec().lateral, cluster, heights);
  if (cluster.leans)
    SetLeans(leans, cluster);
  else
    std::fill_n(cluster.z_by_t.begin(), cluster.feet.count, 0.0);
  for (std::size_t i = 0; i < cluster.feet.count; ++i) {
    cluster.z_m[i] += heights.z[i];
    cluster.z_by_s[i] += heights.by_s[i];
    cluster.z_by_t[i] += heights.by_t[i];
  }
  return true;
}

}  // namespace

bool Network::QueryBatch(Cluster& cluster) const {
  geometry::AxisFeet& feet = cluster.feet;
  if (!AllOnEarth(feet.x_m, feet.count) || !AllOnEarth(feet.y_m, feet.count)) return false;
  double west, east, south, north;
  Range(feet.x_m, feet.count, west, east);
  Range(feet.y_m, feet.count, south, north);
  const Eigen::Vector2d low(west, south), high(east, north);
  const auto found = FindBand(index_, spec_.roads, low, high);
  if (!found) return false;
  const Band& band = index_.bands()[found->band];
  const Road& road = spec_.roads[band.road];
  const geometry::AxisPanel& panel = road.axis().panels()[band.panel];
  if (road.spec().ground != nullptr || !geometry::FindFeet(road.axis(), panel, feet)) return false;
  for (std::size_t i = 0; i < feet.count; ++i) cluster.s_m[i] = panel.middle_s_m + feet.u_m[i];
  const double low_s = std::max(panel.begin_s_m(), 0.0), high_s = std::min(panel.end_s_m(), road.length_m());
  const auto set_ranges = [&] {
    Range(cluster.s_m, feet.count, cluster.low_s_m, cluster.high_s_m);
    return cluster.low_s_m >= low_s && cluster.high_s_m <= high_s;
  };
  if (!set_ranges()) return false;
  ClusterLeans leans;
  cluster.leans = false;
  if (road.rolled()) {
    const InForce superelevation(road.spec().superelevation, cluster);
    if (!superelevation.common()) return false;
    cluster.leans = !IsZero(superelevation.record());
    if (cluster.leans && !(SettleTogether(road, panel, superelevation.record(), cluster, leans) && set_ranges()))
      return false;
  }
  if (!IsApart(*found, index_, road, cluster)) return false;
  Range(feet.t_m, feet.count, cluster.low_t_m, cluster.high_t_m);
  cluster.road = band.road;
  cluster.section = static_cast<std::uint32_t>(road.SectionIndex(cluster.low_s_m));
  if (road.SectionIndex(cluster.high_s_m) != cluster.section) return false;
  return FindLanes(road, road.spec().sections[cluster.section], cluster) && SetSurface(road, leans, cluster);
}

}  // namespace rodeira::network

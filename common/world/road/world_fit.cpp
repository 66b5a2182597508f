// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/world_fit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace rodeira::road {
namespace {

constexpr double kOutlineStep_m = 1.0;
constexpr double kSharpest = 0.95;    // curvature times the half width on the inner side
constexpr double kNearerBy_m = 1e-6;  // what a projection may err, generously
constexpr double kCapStep_rad = 0.05;

// Whether no element of the axis bends so sharply that the blend's inner edge nears the centre of the bend.
bool BendsAreWide(const Road& road, const config::Map& map) {
  const auto& pieces = road.plan().pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const double curvature : {pieces[i].curvature_start_1pm, pieces[i].curvature_end_1pm}) {
      const double inner = curvature > 0.0 ? road.section().blend_left_m() : -road.section().blend_right_m();
      if (std::fabs(curvature) * inner <= kSharpest) continue;
      const auto axis = map.Items("axis");
      axis.Problem(i, "config.out_of_range",
                   fmt::format("the bend of radius {:.6g} m is too sharp for lanes, shoulder, verge and blend of "
                               "together {:.6g} m on its inner side",
                               1.0 / std::fabs(curvature), inner));
      return false;
    }
  }
  return true;
}

// Points on the outline of the road with its blend.
struct OutlinePoint {
  double s_m;
  Eigen::Vector2d p_W;
  double distance_m;  // what the distance to the axis should be
};

std::vector<OutlinePoint> Outline(const Road& road) {
  std::vector<OutlinePoint> points;
  const int steps = static_cast<int>(std::ceil(road.length_m() / kOutlineStep_m));
  for (int i = 0; i <= steps; ++i) {
    const double s = road.length_m() * i / steps;
    for (const double t : {road.section().blend_left_m(), road.section().blend_right_m()}) {
      points.push_back({s, road.Position(s, t).head<2>(), std::fabs(t)});
    }
  }
  // Beyond each end a cap: as far from the end as the wider side reaches.
  const double reach = road.section().reach_m();
  for (const double s : {0.0, road.length_m()}) {
    const geometry::PlanPoint end = road.plan().Evaluate(s);
    const Eigen::Vector2d outward = s == 0.0 ? Eigen::Vector2d(-end.tangent_W) : end.tangent_W;
    for (double angle = -1.55; angle <= 1.55; angle += kCapStep_rad) {
      points.push_back({s, end.p_W + reach * (std::cos(angle) * outward + std::sin(angle) * end.left_W()), reach});
    }
  }
  return points;
}

}  // namespace

void CheckRoadFits(const Road& road, const terrain::ElevationGrid* grid, const config::Map& map) {
  if (!BendsAreWide(road, map)) return;  // the rest would only tell the same again
  bool left_terrain = false, met_itself = false;
  for (const OutlinePoint& point : Outline(road)) {
    if (grid != nullptr && !left_terrain && !grid->At(point.p_W.x(), point.p_W.y()).inside) {
      left_terrain = true;
      map.Problem("axis", "world.outside_of_terrain",
                  fmt::format("road '{}' with its blend leaves the terrain at s = {:.0f} m, near ({:.1f}, {:.1f})",
                              road.id(), point.s_m, point.p_W.x(), point.p_W.y()));
    }
    const geometry::Foot foot = road.plan().Project(point.p_W.x(), point.p_W.y());
    if (!met_itself && foot.distance_m < point.distance_m - kNearerBy_m) {
      met_itself = true;
      map.Problem(
          "axis", "world.road_does_not_fit",
          fmt::format(
              "road '{}' comes too near to itself: the blend at s = {:.0f} m reaches what belongs to s = {:.0f} m; "
              "move the axis or narrow 'blend_m'",
              road.id(), point.s_m, foot.s_m));
    }
  }
}

}  // namespace rodeira::road

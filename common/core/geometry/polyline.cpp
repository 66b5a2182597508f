// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/polyline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/tolerances.hpp"

namespace rodeira::geometry {
namespace {

constexpr double kClosed_m = 1e-6;

double PlanDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).head<2>().norm(); }

}  // namespace

bool Polyline::closed() const {
  return points_W.size() >= 4 && PlanDistance(points_W.front(), points_W.back()) <= kClosed_m;
}

std::vector<double> StationsOf(const Polyline& line) {
  std::vector<double> stations;
  for (std::size_t i = 0; i < line.points_W.size(); ++i) {
    stations.push_back(i == 0 ? 0.0 : stations.back() + PlanDistance(line.points_W[i - 1], line.points_W[i]));
  }
  return stations;
}

Polyline Translated(Polyline line, const Eigen::Vector3d& by_m) {
  for (Eigen::Vector3d& p : line.points_W) p += by_m;
  return line;
}

Polyline Rotated(Polyline line, double angle_rad, const Eigen::Vector2d& about_W) {
  const double cosine = std::cos(angle_rad), sine = std::sin(angle_rad);
  for (Eigen::Vector3d& p : line.points_W) {
    const Eigen::Vector2d from = p.head<2>() - about_W;
    p.head<2>() = about_W + Eigen::Vector2d(cosine * from.x() - sine * from.y(), sine * from.x() + cosine * from.y());
  }
  return line;
}

Polyline Scaled(Polyline line, double plan_factor, double z_factor, const Eigen::Vector3d& about_W) {
  RODEIRA_ASSERT(plan_factor > 0.0 && z_factor > 0.0);
  const Eigen::Vector3d factors(plan_factor, plan_factor, z_factor);
  for (Eigen::Vector3d& p : line.points_W) p = about_W + factors.cwiseProduct(p - about_W);
  return line;
}

Polyline Reversed(Polyline line) {
  std::reverse(line.points_W.begin(), line.points_W.end());
  return line;
}

base::Result<Polyline> Joined(std::span<const Polyline> lines, std::span<const std::string> names,
                              const JoinRules& rules) {
  RODEIRA_ASSERT(!lines.empty() && lines.size() == names.size());
  Polyline joined = lines[0];
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].has_z != joined.has_z) {
      return base::WrongInput("polyline.does_not_join",
                              fmt::format("'{}' and '{}' do not both have heights (z_m)", names[i - 1], names[i]));
    }
    const Eigen::Vector3d end = joined.points_W.back();
    const double to_begin = (lines[i].points_W.front() - end).norm(), to_end = (lines[i].points_W.back() - end).norm();
    const bool turned = rules.turn && to_end < to_begin;
    const Polyline next = turned ? Reversed(lines[i]) : lines[i];
    const double gap = turned ? to_end : to_begin;
    if (gap > rules.within_m && !rules.bridge) {
      return base::WrongInput(
          "polyline.does_not_join",
          fmt::format("'{}' begins {:.6g} m from where '{}' ends; at most {} m were expected{}", names[i], gap,
                      names[i - 1], rules.within_m,
                      to_end <= rules.within_m ? " (its end lies there: --turn turns it round)" : ""));
    }
    const bool same = gap <= rules.within_m || PlanDistance(next.points_W.front(), end) <= kSamePoint_m;
    for (std::size_t k = same ? 1 : 0; k < next.points_W.size(); ++k) {
      if (PlanDistance(next.points_W[k], joined.points_W.back()) > kSamePoint_m)
        joined.points_W.push_back(next.points_W[k]);
    }
  }
  return joined;
}

}  // namespace rodeira::geometry

// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/settle.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"

namespace rodeira::network {
namespace {

SurfaceSample SurfaceOn(const Road& road, const geometry::AxisPanel* panel, double s_m, double t_m) {
  const LaneSection& section = road.SectionAt(s_m);
  double outside_m;
  const LaneSpan span = road.shaped() ? section.At(t_m, road.CentreAt(s_m), s_m, outside_m) : LaneSpan{};
  return panel == nullptr ? road.Surface(s_m, t_m, section, span)
                          : road.Surface(road.axis().At(*panel, s_m - panel->middle_s_m), s_m, t_m, section, span);
}

}  // namespace

double SettleOn(const Road& road, const geometry::AxisPanel* panel, const Eigen::Vector2d& p_W, double low_s_m,
                double high_s_m, double& s_m, double& t_m) {
  Eigen::Vector2d left = Eigen::Vector2d::Zero();
  for (int iteration = 0; iteration < 12; ++iteration) {
    const SurfaceSample at = SurfaceOn(road, panel, s_m, t_m);
    left = p_W - at.p_W.head<2>();
    const Eigen::Vector2d ds = at.ds_W.head<2>(), dt = at.dt_W.head<2>();
    const double area = geometry::Cross(ds, dt);
    if (!(area > 1e-6)) break;
    const double next = std::clamp(s_m + geometry::Cross(left, dt) / area, low_s_m, high_s_m);
    const double s_step = next - s_m;
    const double t_step = (left - s_step * ds).dot(dt) / dt.squaredNorm();  // the nearest to p on the section there
    s_m = next;
    t_m += t_step;
    if (std::fabs(s_step) + std::fabs(t_step) < 1e-10) {
      left -= s_step * ds + t_step * dt;
      break;
    }
  }
  return left.norm() < 1e-9 ? 0.0 : left.norm();
}

void MoveAlongEdge(const Road& road, const geometry::AxisPanel* panel, const Eigen::Vector2d& p_W, double low_s_m,
                   double high_s_m, double t_m, double& s_m) {
  for (int iteration = 0; iteration < 12; ++iteration) {
    const SurfaceSample at = SurfaceOn(road, panel, s_m, t_m);
    const Eigen::Vector2d ds = at.ds_W.head<2>();
    const double next = std::clamp(s_m + (p_W - at.p_W.head<2>()).dot(ds) / ds.squaredNorm(), low_s_m, high_s_m);
    const bool done = std::fabs(next - s_m) < 1e-9;
    s_m = next;
    if (done) break;
  }
}

double DistanceToEdgeOn(const Road& road, const geometry::AxisPanel* panel, const Eigen::Vector2d& p_W, double low_s_m,
                        double high_s_m, double t_m, double& s_m) {
  MoveAlongEdge(road, panel, p_W, low_s_m, high_s_m, t_m, s_m);
  return (p_W - SurfaceOn(road, panel, s_m, t_m).p_W.head<2>()).norm();
}

}  // namespace rodeira::network

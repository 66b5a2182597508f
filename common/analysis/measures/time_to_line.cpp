// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/time_to_line.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/analysis/measures/filters.hpp"

namespace rodeira::measures {
namespace {

using Eigen::Vector2d;
constexpr double kStraight_1pm = 1e-9;  // less curved is straight: 2 micrometres over 60 m

// A line of the lane: y = offset, or a circle about (0, centre_y). The lane's middle passes through the origin along x.
struct LaneLine {
  bool straight = true;
  double offset_m = 0.0;
  double centre_y_m = 0.0, radius_m = 0.0;
};

// At which angles from `start_rad` on, counter-clockwise, does a point on a circle meet the line? Calls meet(angle), in
// [0, 2 pi).
template <class Meet>
void MeetLine(const Vector2d& centre, double radius, double start_rad, double turn, const LaneLine& line,
              const Meet& meet) {
  const auto add = [&](double angle) {
    double from_start = turn * (angle - start_rad);
    from_start -= 2.0 * std::numbers::pi * std::floor(from_start / (2.0 * std::numbers::pi));
    meet(from_start);
  };
  if (line.straight) {
    const double sine = (line.offset_m - centre.y()) / radius;
    if (std::abs(sine) > 1.0) return;
    add(std::asin(sine));
    add(std::numbers::pi - std::asin(sine));
    return;
  }
  const Vector2d between = Vector2d(0.0, line.centre_y_m) - centre;
  const double distance = between.norm();
  if (distance == 0.0) return;
  const double cosine =
      (distance * distance + radius * radius - line.radius_m * line.radius_m) / (2.0 * distance * radius);
  if (std::abs(cosine) > 1.0) return;
  const double towards = std::atan2(between.y(), between.x());
  add(towards + std::acos(cosine));
  add(towards - std::acos(cosine));
}

// The first distance along a ray at which it meets the line.
std::optional<double> RayMeets(const Vector2d& p, const Vector2d& ahead, const LaneLine& line) {
  if (line.straight) {
    if (ahead.y() == 0.0) return std::nullopt;
    const double way = (line.offset_m - p.y()) / ahead.y();
    return way >= 0.0 ? std::optional(way) : std::nullopt;
  }
  const Vector2d from = p - Vector2d(0.0, line.centre_y_m);
  const double along = from.dot(ahead), beyond = from.squaredNorm() - line.radius_m * line.radius_m;
  const double radicand = along * along - beyond;
  if (radicand < 0.0) return std::nullopt;
  for (const double way : {-along - std::sqrt(radicand), -along + std::sqrt(radicand)}) {
    if (way >= 0.0) return way;
  }
  return std::nullopt;
}

// How far a point lies to the left of the lane's middle.
double OffsetOf(const Vector2d& p, double curvature) {
  if (std::abs(curvature) < kStraight_1pm) return p.y();
  const double radius = 1.0 / curvature;  // with its sign
  return radius - std::copysign((p - Vector2d(0.0, radius)).norm(), radius);
}

LaneLine LineAt(double offset_m, double curvature) {
  if (std::abs(curvature) < kStraight_1pm) return {true, offset_m, 0.0, 0.0};
  return {false, 0.0, 1.0 / curvature, std::abs(1.0 / curvature - offset_m)};
}

}  // namespace

double TrigonometricTlc_s(const LaneApproach& a, double horizon_s) {
  const double values = a.y_m + a.heading_rad + a.speed_mps + a.yaw_radps + a.lane_width_m + a.lane_curvature_1pm;
  if (!std::isfinite(values + a.front_m + a.width_m) || a.lane_width_m <= 0.0) return kMissing;
  const double speed = a.speed_mps;
  const Vector2d ahead(std::cos(a.heading_rad), std::sin(a.heading_rad)), left(-ahead.y(), ahead.x());
  const bool turns = std::abs(a.yaw_radps) > kStraight_1pm * std::max(std::abs(speed), 1.0);
  double least = horizon_s;
  bool found = false;
  const auto take = [&](double t) {
    if (t < 0.0 || t > least) return;
    least = t;
    found = true;
  };
  for (const double side : {1.0, -1.0}) {
    const Vector2d corner = Vector2d(0.0, a.y_m) + a.front_m * ahead + 0.5 * side * a.width_m * left;
    if (std::abs(OffsetOf(corner, a.lane_curvature_1pm)) >= 0.5 * a.lane_width_m) return 0.0;
    for (const double edge : {0.5 * a.lane_width_m, -0.5 * a.lane_width_m}) {
      const LaneLine line = LineAt(edge, a.lane_curvature_1pm);
      if (turns) {
        const Vector2d centre = Vector2d(0.0, a.y_m) + speed / a.yaw_radps * left;
        const Vector2d arm = corner - centre;
        const double turn = std::copysign(1.0, a.yaw_radps);
        MeetLine(centre, arm.norm(), std::atan2(arm.y(), arm.x()), turn, line,
                 [&](double angle) { take(angle / std::abs(a.yaw_radps)); });
      } else if (speed != 0.0) {
        if (const auto way = RayMeets(corner, speed > 0.0 ? ahead : Vector2d(-ahead), line))
          take(*way / std::abs(speed));
      }
    }
  }
  return found ? least : kMissing;
}

double FirstOrderTlc_s(double distance_m, double towards_mps) {
  if (std::isnan(distance_m) || !(towards_mps > 0.0)) return kMissing;
  return std::max(distance_m, 0.0) / towards_mps;
}

double SecondOrderTlc_s(double distance_m, double towards_mps, double towards_mps2) {
  constexpr double kAhead_s = 1.0;
  if (!(towards_mps > 0.0)) return kMissing;
  return FirstOrderTlc_s(distance_m, towards_mps + towards_mps2 * kAhead_s);
}

std::vector<double> ApproachMinima(Series tlc_s) {
  std::vector<double> minima;
  for (const SampleRun& run : ValidRuns(tlc_s)) {
    const auto part = tlc_s.subspan(run.from, run.size());
    minima.push_back(*std::min_element(part.begin(), part.end()));
  }
  return minima;
}

}  // namespace rodeira::measures

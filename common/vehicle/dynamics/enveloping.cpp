// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/enveloping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;

constexpr double kMaxSlope = 2.0;
constexpr double kCell =
    2.0 * kRingReach / kRingPoints;  // length of the ground that a place stands for, share of the radius

// Of the place number i, along the wheel from below the hub.
double SampleOffset(int i, double radius_m) { return (2 * i + 1 - kRingPoints) * 0.5 * kCell * radius_m; }

// Horizontal, along the wheel.
Vector3d Heading(const Vector3d& axle_W) {
  const Vector3d along(axle_W.y(), -axle_W.x(), 0.0);
  const double size = along.norm();
  return size > 1e-6 ? Vector3d(along / size) : Vector3d(Vector3d::UnitX());  // the wheel lies on its side
}

struct Touch {
  double hub_z_m = -std::numeric_limits<double>::infinity();
  double z_m = 0.0;  // of the ground there
  double ahead_m = 0.0;
  double slope = 0.0;    // of the plane, along the wheel
  bool tangent = false;  // to the ground's own plane there; otherwise the ring stands on an edge
  const ground::GroundPoint* point = nullptr;
};

// Where a ring touches one cell's plane: at its lowest point against it, or at the end of the cell that is nearer to
// that.
Touch TouchCell(const ground::GroundPoint& point, double middle_m, const Vector3d& heading, double radius_m) {
  const double half = 0.5 * kCell * radius_m;
  const double slope = std::clamp(-point.normal_W.dot(heading) / point.normal_W.z(), -kMaxSlope, kMaxSlope);
  const double lowest = radius_m * slope / std::sqrt(1.0 + slope * slope);
  Touch touch;
  touch.ahead_m = std::clamp(lowest, middle_m - half, middle_m + half);
  const double over = std::sqrt(radius_m * radius_m - touch.ahead_m * touch.ahead_m);
  touch.z_m = point.z_m + slope * (touch.ahead_m - middle_m);
  touch.hub_z_m = touch.z_m + over;
  touch.tangent = touch.ahead_m == lowest;
  touch.slope = touch.tangent ? slope : touch.ahead_m / over;
  touch.point = &point;
  return touch;
}

void Stand(const Vector3d& hub_W, const Vector3d& heading, double radius_m, std::span<const ground::GroundPoint> points,
           WheelGround& wheel) {
  const ground::GroundPoint& below = points[kRingPoints / 2];
  wheel.inside = below.inside;
  wheel.surface = below.surface;
  if (!wheel.inside) return;
  wheel.edge.reset();
  Touch first;
  for (int i = 0; i < kRingPoints; ++i) {
    const ground::GroundPoint& point = points[static_cast<std::size_t>(i)];
    if (!point.inside) continue;
    const Touch touch = TouchCell(point, SampleOffset(i, radius_m), heading, radius_m);
    if (touch.hub_z_m > first.hub_z_m) first = touch;
  }
  wheel.plane_W = {hub_W.x(), hub_W.y(), first.z_m - first.slope * first.ahead_m};
  wheel.normal_W = first.point->normal_W;
  if (!first.tangent) {
    const Vector3d left(-heading.y(), heading.x(), 0.0);
    const double bank = -first.point->normal_W.dot(left) / first.point->normal_W.z();
    wheel.normal_W = (Vector3d::UnitZ() - first.slope * heading - bank * left).normalized();
  }
  wheel.friction = first.point->friction;
  wheel.surface = first.point->surface;
}

void QueryGroundByRing(ground::Ground& ground, double radius_m, const WheelPlaces& places,
                       const std::array<WheelGround*, kWheels>& wheels) {
  std::array<ground::GroundQuery, kWheels * kRingPoints> queries;
  std::array<ground::GroundPoint, kWheels * kRingPoints> points;
  std::array<Vector3d, kWheels> headings;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const Vector3d& hub = places.hubs_W[i];
    headings[i] = Heading(places.axles_W[i]);
    for (int k = 0; k < kRingPoints; ++k) {
      const double ahead = SampleOffset(k, radius_m);
      queries[i * kRingPoints + static_cast<std::size_t>(k)] = {hub.x() + ahead * headings[i].x(),
                                                                hub.y() + ahead * headings[i].y(), hub.z()};
    }
  }
  ground.Query(queries, points);
  for (std::size_t i = 0; i < kWheels; ++i) {
    Stand(places.hubs_W[i], headings[i], radius_m, std::span(points).subspan(i * kRingPoints, kRingPoints), *wheels[i]);
  }
}

}  // namespace

void QueryGround(ground::Ground& ground, Enveloping enveloping, double radius_m, const WheelPlaces& places,
                 const std::array<WheelGround*, kWheels>& wheels) {
  if (enveloping == Enveloping::kNone)
    QueryGround(ground, places.hubs_W, wheels);
  else
    QueryGroundByRing(ground, radius_m, places, wheels);
}

}  // namespace rodeira::dynamics

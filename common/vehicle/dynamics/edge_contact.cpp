// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/edge_contact.hpp"

#include <algorithm>
#include <cmath>

#include "common/vehicle/dynamics/disc_contact.hpp"

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;

constexpr double kNegligible_m = 2e-4;  // a tyre bears less than its rolling resistance over 0.1 m with it
constexpr double kTightestBend_m = 10;  // radius of a road's crest or dip: planes along it differ by way^2 / (2 radius)
constexpr double kResting_m = 1e-9;     // a hub that moves by less goes nowhere
constexpr double kNearest = 0.2;        // of hub and edge, share of the radius: the rim bears long before

double Lean(const WheelDisc& disc, const Vector3d& normal_W) {
  return disc.axle_W.isZero(0.0) ? 1.0 : LeanOf(disc.axle_W, normal_W);
}

// How far the disc reaches beyond the plane; negative in the air.
double Deflection(const WheelDisc& disc, const WheelGround& ground) {
  return disc.radius_m - (disc.hub_W - ground.plane_W).dot(ground.normal_W) / Lean(disc, ground.normal_W);
}

double SlopeAlong(const WheelGround& ground, const Vector3d& way) {
  return -ground.normal_W.dot(way) / std::max(ground.normal_W.z(), 1e-3);
}

// Height of the plane where the hub is.
double HeightAt(const WheelGround& ground, const Vector3d& at_W) {
  return at_W.z() - (at_W - ground.plane_W).dot(ground.normal_W) / std::max(ground.normal_W.z(), 1e-3);
}

// The plane cut by the upright plane through the hub along `ahead`, in which a wheel meets an edge: its normal there,
// and the hub's distance from it.
struct Section {
  Vector3d normal;
  double over_m;
};
Section SectionOf(const WheelGround& ground, const WheelDisc& disc, const Vector3d& ahead) {
  const Vector3d normal = (Vector3d::UnitZ() - SlopeAlong(ground, ahead) * ahead).normalized();
  return {normal, (disc.hub_W.z() - HeightAt(ground, disc.hub_W)) * normal.z()};
}

// From the edge, a level line across its way, to the hub; from the wall below it where the hub is lower.
Vector3d ToHub(const GroundEdge& edge, const WheelDisc& disc) {
  const Vector3d along(-edge.ahead_W.y(), edge.ahead_W.x(), 0.0);
  Vector3d way = disc.hub_W - edge.point_W;
  way.z() = std::max(0.0, way.z());
  return way - way.dot(along) * along;
}

void StandOn(const GroundEdge& edge, const WheelDisc& disc, WheelGround& wheel) {
  const Vector3d way = ToHub(edge, disc);
  wheel.edge = edge;
  wheel.plane_W = disc.hub_W - way;
  wheel.normal_W = way.normalized();
}

// Whether the wheel still turns about the edge.
bool IsValid(const GroundEdge& edge, const WheelDisc& disc, const WheelGround& ground) {
  const Vector3d way = ToHub(edge, disc);
  if (way.norm() < kNearest * disc.radius_m) return false;
  if (edge.rises) return way.dot(edge.ahead_W) < 0.0;
  const Section face = SectionOf(ground, disc, edge.ahead_W);
  return way.dot(edge.ahead_W) >= 0.0 && (way - face.over_m * face.normal).dot(edge.ahead_W) < 0.0;
}

// Where the old plane ends: where both meet, within the way that the hub has moved.
GroundEdge FallingEdge(const WheelGround& before, const WheelGround& ground, const WheelDisc& disc,
                       const Vector3d& ahead, double moved_m) {
  const double height_m = HeightAt(before, disc.hub_W), slope = SlopeAlong(before, ahead);
  const double steeper = slope - SlopeAlong(ground, ahead);
  double at_m = steeper > 0.0 ? (HeightAt(ground, disc.hub_W) - height_m) / steeper : 0.0;
  at_m = std::clamp(at_m, -moved_m, 0.0);
  return {
      {disc.hub_W.x() + at_m * ahead.x(), disc.hub_W.y() + at_m * ahead.y(), height_m + slope * at_m}, ahead, false};
}

// Ahead on the ground's plane, so that the disc is pressed in by `pressed_m`.
GroundEdge RisingEdge(const WheelGround& ground, const WheelDisc& disc, const Vector3d& ahead, double pressed_m) {
  const double reach_m = std::max(disc.radius_m - pressed_m, kNearest * disc.radius_m);
  const double over_m = std::clamp((disc.hub_W - ground.plane_W).dot(ground.normal_W), 0.0, reach_m);
  const Vector3d along = (ahead - ahead.dot(ground.normal_W) * ground.normal_W).normalized();
  const double at_m = std::sqrt(reach_m * reach_m - over_m * over_m);
  const Vector3d side(-ahead.y(), ahead.x(), 0.0);
  Vector3d way = over_m * ground.normal_W - at_m * along;
  way = (way - way.dot(side) * side).normalized();  // ToHub leaves out what lies along the edge
  return {disc.hub_W - reach_m * Lean(disc, way) * way, ahead, true};
}

// How deep the lowest corner of the box lies under the plane; negative above it.
double Depth(const Plane& plane, const Eigen::Isometry3d& X_WB, const BodyBox& box) {
  const Vector3d down_B = X_WB.linear().transpose() * plane.normal_W;
  const double above_m = (X_WB * box.centre_B - plane.point_W).dot(plane.normal_W);
  return box.half_m.dot(down_B.cwiseAbs()) - above_m;
}

}  // namespace

double LoweredBy(const Plane& before, double lowered_m, const Plane& now, const Eigen::Isometry3d& X_WB,
                 const BodyBox& box) {
  const double depth_m = Depth(now, X_WB, box);
  if (!(depth_m > 0.0)) return 0.0;
  const double surplus_m = depth_m - std::max(0.0, Depth(before, X_WB, box) - lowered_m);
  return surplus_m > kResting_m ? surplus_m : 0.0;
}

void RollOn(const WheelGround& before, const WheelDisc& disc, WheelGround& wheel) {
  if (!wheel.inside) return;
  const double reaches_m = Deflection(disc, wheel);
  if (!(reaches_m > kNegligible_m) || !before.inside) return;
  WheelGround old = before;
  if (before.edge) StandOn(*before.edge, disc, old);
  const double pressed_m = std::max(0.0, Deflection(disc, old));
  Vector3d ahead = before.edge ? before.edge->ahead_W : Vector3d(wheel.plane_W - before.plane_W);
  ahead.z() = 0.0;
  const double moved_m = ahead.norm(), bent_m = before.edge ? 0.0 : moved_m * moved_m / (2.0 * kTightestBend_m);
  if (reaches_m <= pressed_m + std::max(kNegligible_m, bent_m)) return;
  if (before.edge && IsValid(*before.edge, disc, wheel)) return StandOn(*before.edge, disc, wheel);
  if (moved_m < kResting_m) return;
  ahead /= moved_m;
  const bool falls = HeightAt(wheel, disc.hub_W) < HeightAt(old, disc.hub_W);
  if (falls && !(before.edge && !before.edge->rises)) {
    const GroundEdge edge = FallingEdge(old, wheel, disc, ahead, before.edge ? 0.0 : moved_m);
    if (IsValid(edge, disc, wheel)) return StandOn(edge, disc, wheel);
  }
  StandOn(RisingEdge(wheel, disc, ahead, pressed_m), disc, wheel);
}

}  // namespace rodeira::dynamics

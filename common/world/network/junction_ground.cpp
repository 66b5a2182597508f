// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/junction_ground.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "common/core/base/bytes.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/core/geometry/polygon.hpp"

namespace rodeira::network {
namespace {

constexpr double kSlopeStep_m =
    1e-5;  // over which slopes within a mouth are found: its height has no simple derivative
constexpr double kOnTheSide = 1e-9;

// A point of a piece with four corners: `across` of the way from the first to the second, `inward` of the way from
// there to the other two.
struct InPiece {
  double across = 0.5, inward = 0.5;
};

// False where it lies beside the piece.
bool FindIn(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& p_W, InPiece& at) {
  const Eigen::Vector2d twist = corners[2] - corners[3] - corners[1] + corners[0], over = corners[1] - corners[0],
                        in = corners[3] - corners[0];
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Eigen::Vector2d left = p_W - corners[0] - at.across * at.inward * twist - at.across * over - at.inward * in;
    const Eigen::Vector2d by_across = at.inward * twist + over, by_inward = at.across * twist + in;
    const double area = geometry::Cross(by_across, by_inward);
    if (std::fabs(area) < 1e-12) return false;
    const double across = geometry::Cross(left, by_inward) / area, inward = geometry::Cross(by_across, left) / area;
    at.across += across, at.inward += inward;
    if (std::fabs(across) + std::fabs(inward) < 1e-13) break;
  }
  const auto within = [](double part) { return part >= -kOnTheSide && part <= 1.0 + kOnTheSide; };
  return within(at.across) && within(at.inward);
}

}  // namespace

JunctionGround::JunctionGround(JunctionGrid grid, std::vector<Eigen::Vector2d> boundary_W,
                               std::vector<JunctionMouth> mouths)
    : grid_(std::move(grid)), boundary_(std::move(boundary_W)), mouths_(std::move(mouths)) {
  if (boundary_.empty()) return;
  low_ = high_ = boundary_[0];
  for (const Eigen::Vector2d& p : boundary_) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
}

base::Digest JunctionGround::Digest() const {
  base::ByteWriter out;
  const auto put = [&out](const auto& p) {
    for (const double number : p) out.Put(number + 0.0);  // -0 is 0
  };
  out.Put(grid_.Digest());
  for (const Eigen::Vector2d& p : boundary_) put(p);
  for (const JunctionMouth& mouth : mouths_) {
    for (const Eigen::Vector2d& p : mouth.corners_W) put(p);
    for (const double t_m : {mouth.first_t_m, mouth.second_t_m}) put(mouth.road->Surface(mouth.s_m, t_m).p_W);
  }
  return base::Hash(out.bytes());
}

bool JunctionGround::Contains(const Eigen::Vector2d& p_W) const {
  if (boundary_.empty() || p_W.x() < low_.x() || p_W.y() < low_.y() || p_W.x() > high_.x() || p_W.y() > high_.y())
    return false;
  return geometry::InPolygon(boundary_, p_W);
}

bool JunctionGround::HeightIn(const JunctionMouth& mouth, const Eigen::Vector2d& p_W, double& z_m) const {
  const std::vector<Eigen::Vector2d>& corners = mouth.corners_W;
  InPiece at;
  if (!FindIn(corners, p_W, at)) return false;
  const Eigen::Vector2d from = corners[0] + at.across * (corners[1] - corners[0]),
                        to = corners[3] + at.across * (corners[2] - corners[3]);
  const SurfaceSample road =
      mouth.road->Surface(mouth.s_m, mouth.first_t_m + at.across * (mouth.second_t_m - mouth.first_t_m));
  const Eigen::Vector3d normal = road.ds_W.cross(road.dt_W);
  const GroundHeight grid = grid_.At(to);
  const double rise_from = -normal.head<2>().dot(to - from) / normal.z();
  const double rise_to = grid.slope_x * (to - from).x() + grid.slope_y * (to - from).y();
  const double z = road.p_W.z(), step = grid.z_m - z, l = at.inward;
  z_m = z + l * (rise_from + l * (3.0 * step - 2.0 * rise_from - rise_to + l * (rise_from + rise_to - 2.0 * step)));
  return true;
}

GroundHeight JunctionGround::At(const Eigen::Vector2d& p_W) const {
  for (const JunctionMouth& mouth : mouths_) {
    GroundHeight height;
    if (!HeightIn(mouth, p_W, height.z_m)) continue;
    // Within the piece on both sides where it is, otherwise to the side that is within it.
    const auto slope = [&](const Eigen::Vector2d& step) {
      double before = height.z_m, behind = height.z_m;
      const double length = (HeightIn(mouth, p_W - step, before) ? kSlopeStep_m : 0.0) +
                            (HeightIn(mouth, p_W + step, behind) ? kSlopeStep_m : 0.0);
      return length > 0.0 ? (behind - before) / length : 0.0;
    };
    height.slope_x = slope({kSlopeStep_m, 0.0});
    height.slope_y = slope({0.0, kSlopeStep_m});
    return height;
  }
  return grid_.At(p_W);
}

}  // namespace rodeira::network

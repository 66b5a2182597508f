// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/camera/placing.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr double kMaxGroundRise = 1.5;  // no ground rises faster towards the ray, so that it is not passed through
constexpr double kMinRayStep_m = 0.02;
constexpr double kOutside_m = 5.0;  // of a way where no ground is known
constexpr double kMet_m = 1e-4;
constexpr int kHalvings = 40;

// How high a point is over the ground of its level; nothing outside of the world.
std::optional<double> Over(ground::Ground& ground, const Vector3d& p_W) {
  const ground::GroundPoint at = ground.At(p_W.x(), p_W.y(), p_W.z());
  if (at.inside) return p_W.z() - at.z_m;
  return std::nullopt;
}

// Between a point over the ground and one below it, on the level that lies at the first one.
Vector3d Meet(ground::Ground& ground, const Ray& ray, double above_m, double below_m) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m = 0.5 * (above_m + below_m);
    const auto over = Over(ground, ray.from_W + middle_m * ray.along_W);
    (over && *over > 0.0 ? above_m : below_m) = middle_m;
  }
  return ray.from_W + above_m * ray.along_W;
}

}  // namespace

std::optional<Vector3d> GroundOn(ground::Ground& ground, const Ray& ray, double far_m) {
  const double closing =
      std::max(-ray.along_W.z(), 0.0) + kMaxGroundRise * std::hypot(ray.along_W.x(), ray.along_W.y());
  std::optional<double> above_m;  // the last place over the ground
  for (double way_m = 0.0; way_m <= far_m;) {
    const Vector3d at = ray.from_W + way_m * ray.along_W;
    const auto over = Over(ground, at);
    if (!over) {
      way_m += kOutside_m;
      above_m.reset();
      continue;
    }
    if (*over <= kMet_m) {
      if (*over >= -kMet_m) return at;
      if (!above_m) return std::nullopt;
      return Meet(ground, ray, *above_m, way_m);
    }
    above_m = way_m;
    way_m += std::max(kMinRayStep_m, *over / std::max(closing, 1e-6));
  }
  return std::nullopt;
}

CarPlace PlaceAt(const road::World& world, const Vector3d& p_W, double heading_rad) {
  CarPlace place{p_W.x(), p_W.y(), p_W.z(), geometry::WrapAngle(heading_rad), false};
  const network::Network* network = world.network();
  if (network == nullptr) return place;
  const auto found = network->Locate(p_W.x(), p_W.y(), p_W.z());
  if (!found || found->distance_m > 0.0) return place;
  const network::Lane* lane = network->Find(found->lane);
  if (lane == nullptr || !network::IsDrivable(lane->type)) return place;
  const double along = network->roads()[found->lane.road].axis().Evaluate(found->s_m).heading_rad;
  const bool against = lane->direction < 0 || (lane->direction == 0 && std::cos(heading_rad - along) < 0.0);
  place.heading_rad = geometry::WrapAngle(along + (against ? base::kPi : 0.0));
  place.on_lane = true;
  return place;
}

}  // namespace rodeira::scene

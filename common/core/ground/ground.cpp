// SPDX-License-Identifier: Apache-2.0
#include "common/core/ground/ground.hpp"

#include <cmath>

#include "common/core/base/assert.hpp"

namespace rodeira::ground {
namespace {

constexpr double kSameLayer_m = 1e-6;

// Of a row or a column, from the patch's middle.
double Away(double size_m, int index, int count) {
  return count > 1 ? size_m * (static_cast<double>(index) / (count - 1) - 0.5) : 0.0;
}

GroundQuery PointOf(const GroundPatch& patch, const Eigen::Vector2d& ahead, double forward_m, double left_m) {
  return {patch.x_m + ahead.x() * forward_m - ahead.y() * left_m,
          patch.y_m + ahead.y() * forward_m + ahead.x() * left_m, patch.z_hint_m};
}

}  // namespace

std::string_view SurfaceName(Surface surface) {
  switch (surface) {
    case Surface::kOutside:
      return "outside";
    case Surface::kAsphalt:
      return "asphalt";
    case Surface::kConcrete:
      return "concrete";
    case Surface::kGravel:
      return "gravel";
    case Surface::kGrass:
      return "grass";
    case Surface::kSoil:
      return "soil";
    case Surface::kRoadMark:
      return "road_mark";
  }
  return "unknown";
}

GroundPoint Ground::At(double x_m, double y_m, double z_hint_m) {
  const GroundQuery query{x_m, y_m, z_hint_m};
  GroundPoint point;
  Query({&query, 1}, {&point, 1});
  return point;
}

GroundQuery PatchPoint(const GroundPatch& patch, int row, int column) {
  return PointOf(patch, {std::cos(patch.heading_rad), std::sin(patch.heading_rad)},
                 Away(patch.length_m, row, patch.along), Away(patch.width_m, column, patch.across));
}

void Ground::Patch(const GroundPatch& patch, std::span<GroundPoint> points) {
  RODEIRA_ASSERT(patch.along >= 1 && patch.across >= 1 && points.size() == patch.size());
  const Eigen::Vector2d ahead(std::cos(patch.heading_rad), std::sin(patch.heading_rad));
  std::vector<double> left_m;
  for (int column = 0; column < patch.across; ++column) left_m.push_back(Away(patch.width_m, column, patch.across));
  std::vector<GroundQuery> queries(patch.size());
  GroundQuery* query = queries.data();
  for (int row = 0; row < patch.along; ++row) {
    const double forward_m = Away(patch.length_m, row, patch.along);
    for (const double left : left_m) *query++ = PointOf(patch, ahead, forward_m, left);
  }
  Query(queries, points);
}

std::vector<GroundPoint> Ground::Layers(double x_m, double y_m) {
  std::vector<GroundPoint> layers;
  GroundPoint next = At(x_m, y_m);
  while (next.inside && (layers.empty() || next.z_m < layers.back().z_m)) {
    layers.push_back(next);
    next = At(x_m, y_m, next.z_m - kSameLayer_m - kMaxAboveHint_m);
  }
  return layers;
}

PlaneGround::PlaneGround(Eigen::Vector3d origin, double slope_x, double slope_y, double friction, Surface surface)
    : origin_(origin), slope_x_(slope_x), slope_y_(slope_y), friction_(friction), surface_(surface) {}

void PlaneGround::Query(std::span<const GroundQuery> queries, std::span<GroundPoint> points) {
  RODEIRA_ASSERT(queries.size() == points.size());
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope_x_, -slope_y_, 1.0).normalized();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double z =
        origin_.z() + slope_x_ * (queries[i].x_m - origin_.x()) + slope_y_ * (queries[i].y_m - origin_.y());
    points[i] = {z, normal, friction_, surface_, true};
  }
}

}  // namespace rodeira::ground

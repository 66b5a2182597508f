#include "common/terrain/ground.hpp"

#include "common/base/assert.hpp"

namespace rodeira::terrain {

std::string_view SurfaceName(Surface surface) {
  switch (surface) {
    case Surface::kOutside: return "outside";
    case Surface::kAsphalt: return "asphalt";
    case Surface::kConcrete: return "concrete";
    case Surface::kGravel: return "gravel";
    case Surface::kGrass: return "grass";
    case Surface::kSoil: return "soil";
    case Surface::kRoadMark: return "road_mark";
  }
  return "unknown";
}

GroundPoint Ground::At(double x_m, double y_m, double z_hint_m) {
  const GroundQuery query{x_m, y_m, z_hint_m};
  GroundPoint point;
  Query({&query, 1}, {&point, 1});
  return point;
}

PlaneGround::PlaneGround(Eigen::Vector3d origin, double slope_x, double slope_y, double friction, Surface surface)
    : origin_(origin), slope_x_(slope_x), slope_y_(slope_y), friction_(friction), surface_(surface) {}

void PlaneGround::Query(std::span<const GroundQuery> queries, std::span<GroundPoint> points) {
  RODEIRA_ASSERT(queries.size() == points.size());
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope_x_, -slope_y_, 1.0).normalized();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double z = origin_.z() + slope_x_ * (queries[i].x_m - origin_.x()) + slope_y_ * (queries[i].y_m - origin_.y());
    points[i] = {z, normal, friction_, surface_, true};
  }
}

}  // namespace rodeira::terrain

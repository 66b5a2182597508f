#include "common/road/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/assert.hpp"
#include "common/road/network_ground.hpp"
#include "common/road/road_network.hpp"
#include "common/road/world_hash.hpp"

namespace rodeira::road {
namespace {

// SUELO on a world: nothing but World::At, a point at a time.
class WorldGround final : public terrain::Ground {
 public:
  explicit WorldGround(std::shared_ptr<const World> world) : world_(std::move(world)) {}

  void Query(std::span<const terrain::GroundQuery> queries, std::span<terrain::GroundPoint> points) override {
    RODEIRA_ASSERT(queries.size() == points.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const SurfacePoint at = world_->At(queries[i].x_m, queries[i].y_m, queries[i].z_hint_m);
      if (!at.inside) {
        points[i] = {};
        continue;
      }
      const double length = std::sqrt(at.slope_x * at.slope_x + at.slope_y * at.slope_y + 1.0);
      points[i].z_m = at.z_m;
      points[i].normal_W = {-at.slope_x / length, -at.slope_y / length, 1.0 / length};
      points[i].friction = at.friction;
      points[i].surface = at.surface;
      points[i].inside = true;
    }
  }

 private:
  std::shared_ptr<const World> world_;
};

}  // namespace

World::World(WorldSpec spec)
    : name_(spec.name),
      grid_(spec.grid),
      plane_(spec.plane),
      network_(spec.network),
      terrain_surface_(spec.terrain_surface),
      terrain_friction_(spec.terrain_friction.value_or(spec.friction[static_cast<std::size_t>(spec.terrain_surface)])),
      friction_(spec.friction),
      start_(spec.start),
      content_hash_(ContentHash(spec)) {
  RODEIRA_ASSERT(grid_ == nullptr || !plane_);
  RODEIRA_ASSERT(grid_ != nullptr || plane_ || network_ != nullptr);
  for (const RoadSpec& road : spec.roads) roads_.emplace_back(road);
  if (!roads_.empty()) network_ = AsNetwork(spec, roads_);
}

std::shared_ptr<const World> World::Make(WorldSpec spec) { return std::shared_ptr<const World>(new World(std::move(spec))); }

Extents World::extents() const {
  if (grid_ != nullptr) return {grid_->frame().west_m, grid_->frame().south_m, grid_->frame().east_m, grid_->frame().north_m};
  if (open_drive()) return NetworkExtents(*network_);
  const double infinity = std::numeric_limits<double>::infinity();
  return {-infinity, -infinity, infinity, infinity};
}

std::unique_ptr<terrain::Ground> World::MakeGround() const { return std::make_unique<WorldGround>(shared_from_this()); }

SurfacePoint World::TerrainAt(double x_m, double y_m) const {
  SurfacePoint point;
  if (grid_ != nullptr) {
    const terrain::GridSample sample = grid_->At(x_m, y_m);
    if (!sample.inside) return point;
    point = {sample.z_m, sample.slope_x, sample.slope_y, terrain_friction_, terrain_surface_, true};
  } else if (plane_ && std::isfinite(x_m) && std::isfinite(y_m)) {
    const double z = plane_->z_m + plane_->slope_x * x_m + plane_->slope_y * y_m;
    point = {z, plane_->slope_x, plane_->slope_y, terrain_friction_, terrain_surface_, true};
  }
  return point;
}

SurfacePoint World::At(double x_m, double y_m, double z_hint_m) const {
  if (open_drive()) return NetworkGround(*network_, friction_, x_m, y_m, z_hint_m);
  SurfacePoint point = TerrainAt(x_m, y_m);
  for (const Road& road : roads_) {
    if (road.plan().MayReach(x_m, y_m)) LayRoad(road, x_m, y_m, point);
  }
  return point;
}

void World::LayRoad(const Road& road, double x_m, double y_m, SurfacePoint& point) const {
  const geometry::Foot foot = road.plan().Project(x_m, y_m);
  const Section& section = road.section();
  const double aside = foot.t_m - std::clamp(foot.t_m, section.verge_right_m(), section.verge_left_m());
  const double excess = std::sqrt(aside * aside + foot.beyond_m * foot.beyond_m);  // distance from the verges' outline
  const double blend = section.spec().blend_m;
  if (excess >= blend) return;

  // The road's own surface, going on in its slopes beyond the verge and beyond the ends.
  const geometry::ProfilePoint profile = road.profile().Evaluate(foot.s_m);
  const Band& band = section.BandAt(foot.t_m);
  const Eigen::Vector2d& along_W = foot.at.tangent_W;
  const Eigen::Vector2d left_W = foot.at.left_W();
  // Along the axis s grows by 1 / (1 - k t) a metre; past an end it stands still and the straight distance counts.
  const double stretch = foot.beyond_m == 0.0 ? 1.0 / (1.0 - foot.at.curvature_1pm * foot.t_m) : 1.0;
  const double z = profile.z_m + profile.grade * foot.beyond_m + band.from_z_m + band.slope * (foot.t_m - band.from_t_m);
  const Eigen::Vector2d slope = profile.grade * stretch * along_W + band.slope * left_W;
  if (excess == 0.0) {
    const bool painted = road.IsPainted(foot.s_m, foot.t_m, foot.at.heading_rad);
    const terrain::Surface surface = painted ? terrain::Surface::kRoadMark : band.surface;
    point = {z, slope.x(), slope.y(), Friction(surface), surface, true};
    return;
  }
  if (!point.inside) return;
  const double u = excess / blend;
  const double weight = u * u * (3.0 - 2.0 * u);
  const double weight_slope = 6.0 * u * (1.0 - u) / blend;
  const Eigen::Vector2d outward_W = (aside * left_W + foot.beyond_m * along_W) / excess;
  const double step = point.z_m - z;
  point.slope_x = slope.x() + weight * (point.slope_x - slope.x()) + weight_slope * step * outward_W.x();
  point.slope_y = slope.y() + weight * (point.slope_y - slope.y()) + weight_slope * step * outward_W.y();
  point.z_m = z + weight * step;
}

}  // namespace rodeira::road

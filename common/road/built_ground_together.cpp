// SUELO for many points that lie close together on one road: by the same formulas as a point alone, each step for all of them.
#include <algorithm>
#include <cmath>

#include "common/network/cluster.hpp"
#include "common/road/built_ground.hpp"

namespace rodeira::road {
namespace {

using Numbers = network::Cluster::Numbers;

// As BuiltGround::OnRoad and the ground's normal of it.
void SetNormals(const network::Cluster& cluster, Numbers& normal_x, Numbers& normal_y, Numbers& up) {
  for (std::size_t i = 0; i < cluster.feet.count; ++i) {
    const double tangent_x = cluster.feet.tangent_x[i], tangent_y = cluster.feet.tangent_y[i];
    const double pace = 1.0 - cluster.feet.curvature_1pm[i] * cluster.feet.t_m[i];
    const double ds_x = pace * tangent_x, ds_y = pace * tangent_y, ds_z = cluster.z_by_s[i];
    const double dt_x = -tangent_y, dt_y = tangent_x, dt_z = cluster.z_by_t[i];
    const double down = -1.0 / (ds_x * dt_y - ds_y * dt_x);
    const double slope_x = (ds_y * dt_z - ds_z * dt_y) * down, slope_y = (ds_z * dt_x - ds_x * dt_z) * down;
    up[i] = 1.0 / std::sqrt(slope_x * slope_x + slope_y * slope_y + 1.0);
    normal_x[i] = -slope_x * up[i];
    normal_y[i] = -slope_y * up[i];
  }
}

}  // namespace

// Whether no junction is near, no bridge or tunnel, and nothing stands on the road or in its place.
bool BuiltGround::OneRoadAlone(const network::Cluster& cluster) const {
  if (in_junction_[cluster.road] || detail_.On(cluster.road)) return false;
  const auto near = [&](const network::Structure& structure) {
    return cluster.high_s_m >= structure.s_m && cluster.low_s_m <= structure.s_m + structure.length_m;
  };
  const auto& structures = network_->roads()[cluster.road].spec().structures;
  if (std::any_of(structures.begin(), structures.end(), near)) return false;
  constexpr double kNear_m = 1e-3;
  const Eigen::Vector2d first(cluster.feet.x_m[0], cluster.feet.y_m[0]);
  const double reach = std::sqrt(2.0) * network::BandIndex::kWidest_m + kNear_m;
  return std::none_of(junctions_.begin(), junctions_.end(), [&](const auto& junction) {
    return ((junction->low_W() - first).array() <= reach).all() && ((first - junction->high_W()).array() <= reach).all();
  });
}

bool BuiltGround::Together(std::span<const terrain::GroundQuery> queries, std::span<terrain::GroundPoint> points) const {
  network::Cluster cluster;
  cluster.feet.count = queries.size();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    cluster.feet.x_m[i] = queries[i].x_m;
    cluster.feet.y_m[i] = queries[i].y_m;
  }
  if (!network_->Together(cluster) || !OneRoadAlone(cluster)) return false;
  Numbers normal_x, normal_y, up;
  SetNormals(cluster, normal_x, normal_y, up);
  const auto ground_at = [&](int lane, double s) -> const LaneGround& {
    return grounds_.At(*network_, {cluster.road, cluster.section, lane}, s);
  };
  const LaneGround* common = nullptr;
  if (cluster.lane != 0 && &ground_at(cluster.lane, cluster.low_s_m) == &ground_at(cluster.lane, cluster.high_s_m)) {
    common = &ground_at(cluster.lane, cluster.low_s_m);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LaneGround& ground = common != nullptr ? *common : ground_at(cluster.LaneOf(i), cluster.s_m[i]);
    points[i] = {cluster.z_m[i], {normal_x[i], normal_y[i], up[i]}, ground.friction, ground.surface, true};
  }
  if (!paint_.MayBe(cluster.road, cluster.low_s_m, cluster.high_s_m, cluster.low_t_m, cluster.high_t_m)) return true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!paint_.At(cluster.road, cluster.s_m[i], cluster.feet.t_m[i])) continue;
    points[i].surface = terrain::Surface::kRoadMark;
    points[i].friction = friction_[static_cast<std::size_t>(terrain::Surface::kRoadMark)];
  }
  return true;
}

}  // namespace rodeira::road

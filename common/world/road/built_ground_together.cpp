// SPDX-License-Identifier: Apache-2.0
// SUELO for many points that lie close together on one road: by the same formulas as a point alone, each step for all
// of them.
#include <algorithm>
#include <cmath>

#include "common/world/network/cluster.hpp"
#include "common/world/road/built_ground.hpp"
#include "common/world/road/cluster_points.hpp"

namespace rodeira::road {

// Whether no junction is near, no bridge or tunnel of this or another road, and nothing stands on the road or in its
// place.
bool BuiltGround::OneRoadAlone(const network::Cluster& cluster) const {
  if (in_junction_[cluster.road] || detail_.On(cluster.road, cluster.low_s_m, cluster.high_s_m)) return false;
  const auto near = [&](const network::Structure& structure) {
    return cluster.high_s_m >= structure.s_m && cluster.low_s_m <= structure.s_m + structure.length_m;
  };
  const auto& structures = network_->roads()[cluster.road].spec().structures;
  if (std::any_of(structures.begin(), structures.end(), near)) return false;
  constexpr double kNear_m = 1e-3;
  const Eigen::Vector2d first(cluster.feet.x_m[0], cluster.feet.y_m[0]);
  if (tunnel_sides_.MayHold(first)) return false;
  const double reach = std::sqrt(2.0) * network::BandIndex::kWidest_m + kNear_m;
  return std::none_of(junctions_.begin(), junctions_.end(), [&](const auto& junction) {
    return ((junction->low_W() - first).array() <= reach).all() &&
           ((first - junction->high_W()).array() <= reach).all();
  });
}

bool BuiltGround::QueryBatch(std::span<const ground::GroundQuery> queries,
                             std::span<ground::GroundPoint> points) const {
  network::Cluster cluster;
  SetPlaces(queries, cluster);
  if (!network_->QueryBatch(cluster) || !OneRoadAlone(cluster)) return false;
  ClusterNormals normals;
  SetNormals(
      cluster, [](double part, double up) { return part * (-1.0 / up); }, normals);
  PutPoints(*network_, grounds_, cluster, normals, points);
  if (!paint_.MayBe(cluster.road, cluster.low_s_m, cluster.high_s_m, cluster.low_t_m, cluster.high_t_m)) return true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!paint_.At(cluster.road, cluster.s_m[i], cluster.feet.t_m[i])) continue;
    points[i].surface = ground::Surface::kRoadMark;
    points[i].friction = friction_[static_cast<std::size_t>(ground::Surface::kRoadMark)];
  }
  return true;
}

}  // namespace rodeira::road

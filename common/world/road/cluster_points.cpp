// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/cluster_points.hpp"

namespace rodeira::road {

void SetPlaces(std::span<const ground::GroundQuery> queries, network::Cluster& cluster) {
  cluster.feet.count = queries.size();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    cluster.feet.x_m[i] = queries[i].x_m;
    cluster.feet.y_m[i] = queries[i].y_m;
  }
}

void PutPoints(const network::Network& network, const LaneGrounds& grounds, const network::Cluster& cluster,
               const ClusterNormals& normals, std::span<ground::GroundPoint> points) {
  const auto ground_at = [&](int lane, double s) -> const LaneGround& {
    return grounds.At(network, {cluster.road, cluster.section, lane}, s);
  };
  const LaneGround* common = nullptr;
  if (cluster.lane != 0 && &ground_at(cluster.lane, cluster.low_s_m) == &ground_at(cluster.lane, cluster.high_s_m)) {
    common = &ground_at(cluster.lane, cluster.low_s_m);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LaneGround& ground = common != nullptr ? *common : ground_at(cluster.LaneOf(i), cluster.s_m[i]);
    points[i] = {cluster.z_m[i], {normals.x[i], normals.y[i], normals.up[i]}, ground.friction, ground.surface, true};
  }
}

}  // namespace rodeira::road

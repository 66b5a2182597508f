// SPDX-License-Identifier: Apache-2.0
// SUELO on an OpenDRIVE network for many points that lie close together on one road: by the same formulas as a point
// alone.
#include "common/world/network/cluster.hpp"
#include "common/world/road/cluster_points.hpp"
#include "common/world/road/network_ground.hpp"

namespace rodeira::road {

bool NetworkGroundTogether(const network::Network& network, const LaneGrounds& grounds, const FrictionTable& friction,
                           const MarkPaint* paint, const SurfaceDetail* detail,
                           std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) {
  network::Cluster cluster;
  SetPlaces(queries, cluster);
  if (!network.QueryBatch(cluster) ||
      (detail != nullptr && detail->On(cluster.road, cluster.low_s_m, cluster.high_s_m)))
    return false;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (cluster.z_m[i] > queries[i].z_hint_m + ground::kMaxAboveHint_m) return false;  // what is below is asked for
    if (network.GroundAt({queries[i].x_m, queries[i].y_m}) != nullptr) return false;
  }
  ClusterNormals normals;
  SetNormals(
      cluster, [](double part, double up) { return -part / up; }, normals);
  PutPoints(network, grounds, cluster, normals, points);
  for (std::size_t i = 0; paint != nullptr && i < points.size(); ++i) {
    if (!paint->At(cluster.road, cluster.section, cluster.s_m[i], cluster.feet.t_m[i])) continue;
    points[i].surface = ground::Surface::kRoadMark;
    points[i].friction = friction[static_cast<std::size_t>(ground::Surface::kRoadMark)];
  }
  return true;
}

}  // namespace rodeira::road

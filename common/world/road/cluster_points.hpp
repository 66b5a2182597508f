// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <span>

#include "common/core/ground/ground.hpp"
#include "common/world/network/cluster.hpp"
#include "common/world/network/network.hpp"
#include "common/world/road/lane_grounds.hpp"

namespace rodeira::road {

// Unit normals by point, in W: x to the east, y to the north, up.
struct ClusterNormals {
  network::Cluster::Numbers x, y, up;
};

// The surface's normals at a cluster's points, as a point alone has them: slope(n, up) is what is made of a part n of
// the cross product and its upward part.
template <class Slope>
void SetNormals(const network::Cluster& cluster, const Slope& slope, ClusterNormals& normals) {
  const auto set = [&](std::size_t i, double ds_x, double ds_y, double dt_x, double dt_y, double dt_z) {
    const double ds_z = cluster.z_by_s[i];
    const double up = ds_x * dt_y - ds_y * dt_x;
    const double slope_x = slope(ds_y * dt_z - ds_z * dt_y, up), slope_y = slope(ds_z * dt_x - ds_x * dt_z, up);
    normals.up[i] = 1.0 / std::sqrt(slope_x * slope_x + slope_y * slope_y + 1.0);
    normals.x[i] = -slope_x * normals.up[i];
    normals.y[i] = -slope_y * normals.up[i];
  };
  if (cluster.leans) {
    for (std::size_t i = 0; i < cluster.feet.count; ++i)
      set(i, cluster.ds_x[i], cluster.ds_y[i], cluster.dt_x[i], cluster.dt_y[i], cluster.z_by_t[i]);
    return;
  }
  for (std::size_t i = 0; i < cluster.feet.count; ++i) {
    const double tangent_x = cluster.feet.tangent_x[i], tangent_y = cluster.feet.tangent_y[i];
    const double pace = 1.0 - cluster.feet.curvature_1pm[i] * cluster.feet.t_m[i];
    set(i, pace * tangent_x, pace * tangent_y, -tangent_y, tangent_x, cluster.z_by_t[i]);
  }
}

// Copies where the points lie.
void SetPlaces(std::span<const ground::GroundQuery> queries, network::Cluster& cluster);
// SUELO's answers from heights, normals and what the lanes are made of.
void PutPoints(const network::Network& network, const LaneGrounds& grounds, const network::Cluster& cluster,
               const ClusterNormals& normals, std::span<ground::GroundPoint> points);

}  // namespace rodeira::road

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "common/world/network/band_index.hpp"
#include "common/world/network/cluster.hpp"

// Parts of Network::QueryBatch.
namespace rodeira::network {

// The band that a cluster's points lie on, and which of its neighbours along the road reach over them too.
struct ClusterBand {
  std::uint32_t band = 0;
  bool before = false, behind = false;  // the panel before, the one behind
};

// Of points in a box that is no wider than BandIndex::kWidest_m. Nothing where another road's band, or one of another
// part of the road, holds some of it, and maybe nothing where an edge of a band is near.
std::optional<ClusterBand> FindBand(const BandIndex& index, std::span<const Road> roads, const Eigen::Vector2d& low_W,
                                    const Eigen::Vector2d& high_W);

// Whether the neighbours say nothing of any of the points, with known places on the band: all of them lie before,
// or behind, the line across the road where the neighbour begins by kApart_m or more, and it does not turn back to
// them.
bool IsApart(const ClusterBand& found, const BandIndex& index, const Road& road, const Cluster& cluster);

}  // namespace rodeira::network

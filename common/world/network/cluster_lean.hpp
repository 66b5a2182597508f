// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/network/cluster.hpp"
#include "common/world/network/road.hpp"

// Parts of Network::QueryBatch.
namespace rodeira::network {

// The sections of a cluster's points where they lean, as Lean says.
struct ClusterLeans {
  Cluster::Numbers left, back, up, left_1pm, back_1pm, up_1pm;
};

// Moves a cluster's feet, found in plan on a panel, to where the leaning surface stands over the points: s, t, the
// line's direction and curvature, to the bit what Road::FootOnLean says of each. False, and then nothing is known,
// where it says nothing of one of them, or where superelevation or elevation has another record.
bool SettleTogether(const Road& road, const geometry::AxisPanel& panel, const geometry::Cubic& superelevation,
                    Cluster& cluster, ClusterLeans& leans);

// Adds to the height of the reference line and its slope what the sections' lean is of it, and sets their slope across
// and how the points move seen from above; as Road::Surface.
void SetLeans(const ClusterLeans& leans, Cluster& cluster);

}  // namespace rodeira::network

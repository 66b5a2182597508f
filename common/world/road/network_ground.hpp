// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/network/network.hpp"
#include "common/world/road/lane_grounds.hpp"
#include "common/world/road/mark_paint.hpp"
#include "common/world/road/network_land.hpp"
#include "common/world/road/surface_detail.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::road {

// SUELO on an OpenDRIVE network: of the layers of roads (one_ground.hpp) the highest that is not above the hint by more
// than 0.5 m (without a hint the highest), with the ground and paint (road_mark) of the lane that it is named by;
// beside all roads, and under their decks, the land, of grass.
SurfacePoint NetworkGround(const network::Network& network, const LaneGrounds& grounds, const NetworkLand& land,
                           const FrictionTable& friction, double x_m, double y_m, double z_hint_m,
                           const MarkPaint* paint = nullptr, const SurfaceDetail* detail = nullptr);

// The road, lane, s and t of what NetworkGround answers from, or, on the land, of the road that Network::Locate names
// at its height. Nothing between the roads of a junction that has a ground of its own, and where there is no ground.
std::optional<network::Place> NetworkPlace(const network::Network& network, const NetworkLand& land, double x_m,
                                           double y_m, double z_hint_m);

// NetworkGround of points close to one another, where they lie on one road alone, at or below what their hints ask for:
// to the bit what NetworkGround says of each. False, and then nothing is written, where that is not so or not told so
// quickly. Spans of equal length, of Cluster::kMost at most.
bool NetworkGroundTogether(const network::Network& network, const LaneGrounds& grounds, const FrictionTable& friction,
                           const MarkPaint* paint, const SurfaceDetail* detail,
                           std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points);

// The roads and their verges.
Extents NetworkExtents(const network::Network& network);

}  // namespace rodeira::road

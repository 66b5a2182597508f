// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/zones.hpp"

namespace rodeira::traffic {

// Swept paths of cars with full physics in bends, by track: how far bodies reach beside the lane's line. With front
// steering and the mean of both axles' circles on a line of radius R, a car of wheelbase L has its rear axle on
// ρ = R - L² / (4 R) and its outer front corner on √((ρ + w/2)² + (L + o)²), o being the overhang. Where the
// curvature grows faster than the drivers steer (12 rad/s), or exceeds tan(limit) / L, the front reaches further out.
// Therefore the body with the longest wheelbase is driven kinematically, at the planned speed and slower, over every
// way through bends of a radius below some six wheelbases, by the steering model of these drivers; its outline is
// recorded, as wide as LargestOf says. Empty for tracks without such a bend near, for planar cars, and for MOTORS'
// driver, which uses no zones. Lengths in m.
lanes::Swings SwingsOf(const lanes::Graph& graph, const TrafficSettings& settings);

}  // namespace rodeira::traffic

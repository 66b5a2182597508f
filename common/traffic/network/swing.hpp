// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/zones.hpp"

namespace rodeira::traffic {

// How far cars reach beside the nodes of bends, and of what lies before and behind these, by track. Nothing of tracks
// where no such bend is near, and for MOTORS' driver, who knows no zones.
//
// A planar car has both axles on its line. Where a bend of curvature κ begins, its rear still stands before it and
// swings to the outside, by κ L o / 2 with a wheelbase L and an overhang o; so the largest car is moved along every way
// through bends of less than 25 wheelbases' radius, and its corners are noted.
//
// With full physics a car is steered by its front wheels: with the mean of both axles' circles on a line of radius R, a
// car of wheelbase L has its rear axle on ρ = R - L² / (4 R), its outer corner in front on √((ρ + w/2)² + (L + o)²).
// Where a bend draws in faster than hands turn (12 rad/s), or tighter than the wheels do (tan(limit) / L), its front
// leaves it to the outside by more. So the body with the longest wheelbase that may be there is driven in the plane,
// its wheels rolling, by the hands of these drivers, at the speed of their plan and slower, over every way through
// bends of less than some six wheelbases' radius, and its outline noted, as wide as LargestOf says.
lanes::Swings SwingsOf(const lanes::Graph& graph, const TrafficSettings& settings);

}  // namespace rodeira::traffic

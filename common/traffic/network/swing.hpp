// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/zones.hpp"

namespace rodeira::traffic {

// How far cars with full physics reach beside the nodes of bends, by track. Steered by the front wheels, with the mean
// of both axles' circles on a line of radius R, a car of wheelbase L has its rear axle on ρ = R - L² / (4 R), its outer
// corner in front on √((ρ + w/2)² + (L + o)²) (o: the overhang); where a bend draws in faster than hands turn (12
// rad/s), or tighter than the wheels do (tan(limit) / L), its front leaves it to the outside by more. So the body with
// the longest wheelbase that may be there is driven in the plane, its wheels rolling, by the hands of these drivers, at
// the speed of their plan and slower, over every way through bends of less than some six wheelbases' radius, and its
// outline noted, as wide as LargestOf says. Nothing of tracks where no such bend is near, for planar cars, with axles
// that both keep to the line, and for MOTORS' driver, who knows no zones.
lanes::Swings SwingsOf(const lanes::Graph& graph, const TrafficSettings& settings);

}  // namespace rodeira::traffic

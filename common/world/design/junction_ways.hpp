// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "common/world/design/junction_arms.hpp"
#include "common/world/design/junction_surface.hpp"

namespace rodeira::design {

// The road itself between two arms of one meeting: its drivable lanes only, on the junction's surface, and of its
// objects what is laid on it.
network::Road WayAlong(const network::Road& whole, double from_s_m, double to_s_m, const std::string& id,
                       const std::string& junction, const JunctionSurface& surface);

// A way of one lane from a lane of an arm to one of another, on the junction's surface: lane -1 of a road with an axis
// that is the lane's left edge. nullopt where no curve leads there.
std::optional<network::Road> WayBetween(const ArmLane& from, const Eigen::Vector2d& inward_W, const ArmLane& to,
                                        const Eigen::Vector2d& outward_W, const std::string& id,
                                        const std::string& junction, const JunctionSurface& surface,
                                        const network::Road& like);

// Stop or give-way lines and signs at a minor arm's end, signs of priority at a major one's; into the road's own spec.
void MarkArm(network::RoadSpec& spec, network::End end, Control control, bool major);

}  // namespace rodeira::design

#pragma once

#include "common/scene/moment.hpp"
#include "idl/messages.hpp"

namespace rodeira::view {

// A car's pose from its message; `source` is the number of its stream, `order` its place among the cars (for its paint).
scene::CarPose FromWire(const msg::VehicleState& message, std::uint32_t source, std::size_t order);
// Adds the agents of one source's message, in ascending ids.
void AppendAgents(const msg::TrafficState& message, std::uint32_t source, std::vector<scene::AgentPose>& agents);

}  // namespace rodeira::view

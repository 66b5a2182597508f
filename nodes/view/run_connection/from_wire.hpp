// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string_view>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "idl/messages.hpp"

namespace rodeira::nodes {

// A car's pose from its message; `source` is the number of its stream, `order` its place among the cars (for its
// paint).
scene::CarPose CarPoseOf(const msg::VehicleState& message, std::uint32_t source, std::size_t order);
// Adds the agents of one source's message, in ascending ids.
void AppendAgents(const msg::TrafficState& message, std::uint32_t source, std::vector<scene::AgentPose>& agents);

// Adds what one source says of the lights; they stay ascending.
void AddLights(const msg::SignalsState& message, std::vector<scene::LightShown>& lights);

// Whether a sample is kept as its source's newest: but for details of the traffic that say nothing, which come between
// those that do.
bool SaysSomething(std::string_view topic, const base::Bytes& payload);

// The newest sample of each source that a view looks at: cars, traffic and its details, lights, weather.
using NewestSamples = std::map<lockstep::SourceIndex, std::shared_ptr<const base::Bytes>>;
// Everything as they tell it, at a step. Wrong input where one of them cannot be read.
base::Result<scene::SceneSnapshot> MakeMoment(const lockstep::Roster& roster, lockstep::Step step,
                                              const NewestSamples& newest);

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::nodes {

// The road and terrain server: loads the launch file's world, says what it is, answers SUELO.
base::Result<std::unique_ptr<launch::Service>> MakeRoadService(launch::NodeContext& context);

// What the server says of a world, and what each process that has loaded the world knows too.
launch::WorldSummary Summary(const road::World& world);

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"

namespace rodeira::nodes {

// Publishes the events of a scenario file (docs/reference/scenario-files.md). Configuration: `scenario`. A scheduled
// event stands in the sample that is valid at exactly its time; a conditional one in the next sample after the car was
// seen past the station.
base::Result<std::unique_ptr<lockstep::Node>> MakeScenarioNode(launch::NodeContext& context);

}  // namespace rodeira::nodes

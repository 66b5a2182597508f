// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"

namespace rodeira::nodes {

// Publishes lane, margins and leader of a vehicle during the run, by the code that `rodeira measures` uses. It only
// observes: no other node reads its topic. Configuration: `vehicle` (name of a vehicle node; default: the first one
// that is wired to it). Wrong input without a world, or where no such vehicle is wired to it.
base::Result<std::unique_ptr<lockstep::Node>> MakeMeasuresNode(launch::NodeContext& context);

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"

namespace rodeira::nodes {

// A node that does nothing but take part: it measures the lockstep itself and stands in for others in tests. Its value
// folds everything that it has seen, so that a single wrong sample anywhere changes every digest after it.
// Configuration: `fail_at_step` (it fails there), `hang_at_step` (it computes for ever from there on), `broken`: what a
// verification must find: `clock` (its value depends on the wall clock), `order` (on addresses in memory); `saves:
// false`: its state cannot be saved.
base::Result<std::unique_ptr<lockstep::Node>> MakeEmptyNode(launch::NodeContext& context);

}  // namespace rodeira::nodes

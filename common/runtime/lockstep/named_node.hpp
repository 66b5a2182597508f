// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::lockstep {

// The number of the node that an operator names. Wrong input, with the nearest name: the roster has no such node.
base::Result<NodeIndex> NamedNode(const Roster& roster, const std::string& name);

}  // namespace rodeira::lockstep

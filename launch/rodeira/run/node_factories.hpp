// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "common/runtime/launch/node_context.hpp"

namespace rodeira::cli {

// What makes a node of a kind, for runs in one process and for checks before a run; null for kinds that are services.
launch::NodeFactory FactoryOf(std::string_view kind);
// The same of a node, which may be external: then from its shared object. Wrong input where it runs only as a process
// of its own.
base::Result<launch::NodeFactory> FactoryOf(const launch::LaunchNode& node);

}  // namespace rodeira::cli

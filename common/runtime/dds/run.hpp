// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "common/runtime/launch/node_context.hpp"

// The whole of a process of a run; main.cpp hands its arguments on and returns what comes back (0, 1 or 2).
namespace rodeira::dds {

// A node with activations. `kind` must be the kind of the launch file's node.
int RunNode(std::string_view kind, int argc, char** argv, const launch::NodeFactory& factory);
// A server (SUELO): answers until the run is over.
int RunService(std::string_view kind, int argc, char** argv, const launch::ServiceFactory& factory);
// The clock. Says on standard output, a line each, how the run goes (docs/reference/run-control.md); SIGINT and SIGTERM
// stop the run at the last granted step.
int RunClock(int argc, char** argv);

}  // namespace rodeira::dds

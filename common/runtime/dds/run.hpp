// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "common/runtime/launch/node_context.hpp"
#include "common/runtime/launch/shared_process.hpp"

// The whole of a process of a run; main.cpp hands its arguments on and returns what comes back (0, 1 or 2).
namespace rodeira::dds {

// A node with activations. `kind` must be the kind of the launch file's node.
int RunNode(std::string_view kind, int argc, char** argv, const launch::NodeFactory& factory);
// A server (SUELO): answers until the run is over.
int RunService(std::string_view kind, int argc, char** argv, const launch::ServiceFactory& factory);
// Nodes that share a process (key `process` of the launch file), each on a thread of its own.
struct SharedProcess {
  // What makes one of its nodes: one of both is set, unless there is an error, which is told as the node's.
  struct Factory {
    launch::NodeFactory node;
    launch::ServiceFactory service;
  };
  std::function<base::Result<Factory>(const launch::LaunchNode& node)> factory;
  // Called before the nodes are made: what comes back is kept until they have ended. May be empty.
  std::function<std::shared_ptr<const void>(const launch::Launch& launch,
                                            const std::vector<lockstep::NodeIndex>& nodes)>
      prepare;
};
// `program`: its name in help and errors.
int RunSharedProcess(std::string_view program, int argc, char** argv, const SharedProcess& process);
// The clock. Says on standard output, a line each, how the run goes (docs/reference/run-control.md); SIGINT and SIGTERM
// stop the run at the last granted step.
int RunClock(int argc, char** argv);

}  // namespace rodeira::dds

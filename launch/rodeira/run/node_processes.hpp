// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/shared_process.hpp"
#include "launch/rodeira/run/placement.hpp"
#include "launch/rodeira/run/processes.hpp"
#include "launch/rodeira/run/run_command.hpp"

namespace rodeira::cli {

// The program that runs a process of a run, beside `rodeira` or absolute: a node's own, or that of shared processes.
std::string ProgramOf(const launch::Launch& launch, const launch::NodeProcess& process);

// The processes of a run on this PC: the clock, or its follower, and the nodes. Started, started again, ended.
class NodeProcesses {
 public:
  // All outlive it; options.run is the run's name, options.domain is set.
  NodeProcesses(const RunOptions& options, const Placement& placement, const launch::Launch& launch,
                launch::Overrides overrides);

  // The clock, or on the other PCs of a laboratory its follower. First.
  base::Status StartClock();
  // All nodes of this PC. Failed where a program cannot be started.
  base::Status StartNodes();
  bool has_nodes() const { return has_nodes_; }

  // Where a clock stood that was lost.
  struct ClocksPlace {
    std::uint64_t id = 0;
    std::int64_t begun_ns = -1;  // on the monotonic clock; -1: the run has not begun
    double pace = 0.0;           // 0: as fast as it can
    bool paused = false;
  };
  // Another incarnation of it, which learns from the nodes where the run stands; the old process is dead then.
  base::Status RestartClock(const ClocksPlace& place);
  enum class Restarted {
    kElsewhere,     // the node is another PC's
    kAwaitsOthers,  // of the nodes that share its process: it is restarted when all are to be
    kDone,
  };
  // Another incarnation of a node; the old process is dead once it is done.
  base::Result<Restarted> RestartNode(const std::string& name, std::uint32_t incarnation);

  // All end: by themselves where the run ended in good order, or by force before two seconds have passed since
  // Ctrl-C.
  void EndAll(bool orderly, std::optional<std::chrono::steady_clock::time_point> interrupted_at);

  // The incarnation of a node that this PC runs.
  std::uint32_t incarnation(const std::string& name) const;

  // Child::Poll of all processes.
  void Poll();
  Child& clock() { return children_.front(); }
  const std::vector<Child>& children() const { return children_; }  // the clock first
  // The nodes of a child, the one that it crashed in first; empty for the clock.
  std::vector<std::string> NodesOf(const Child& child) const;
  // Child::Fate, to go on after "node 'x' ": it names a shared process.
  std::string FateOf(const Child& child) const;
  // What the part of this name has written, through all its restarts; null for an unknown one.
  const PartLog* LogOf(const std::string& name) const;

 private:
  PartLog* MakeLog(const std::string& name);
  std::vector<std::string> Command(const std::string& program) const;
  std::vector<std::string> ClockCommand(const std::string& pace) const;

  const RunOptions& options_;
  const Placement& placement_;
  const launch::Launch& launch_;
  launch::Overrides overrides_;
  std::uint32_t domain_;
  std::uint32_t clocks_life_ = 0;
  bool has_nodes_ = false;
  struct Part {
    std::string child;  // name of the child
    launch::NodeProcess process;
  };
  const Part* PartOf(std::string_view child) const;  // null: the clock
  std::vector<std::string> CommandOf(const Part& part) const;
  base::Status Start(const Part& part, Child* place);

  std::vector<Part> parts_;                            // of this PC
  std::map<std::string, std::uint32_t> wanted_;        // incarnations that the clock asks for, by node
  std::map<std::string, std::uint32_t> incarnations_;  // of nodes that were started again
  const std::shared_ptr<bool> exhaustion_told_ = std::make_shared<bool>(false);
  std::map<std::string, std::unique_ptr<PartLog>> logs_;  // by the child's name; outlive the children
  std::vector<Child> children_;
};

}  // namespace rodeira::cli

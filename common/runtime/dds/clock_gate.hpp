// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/runtime/dds/clock_run.hpp"
#include "common/runtime/dds/supervisor_pipe.hpp"
#include "common/runtime/dds/wire.hpp"

namespace rodeira::dds {

// Which nodes take part: which reports count for the clock, which are passed over, and which end the run because two
// processes may not drive together.
class ClockGate {
 public:
  // The run outlives it.
  ClockGate(ClockRun& run, std::uint64_t clock_id);

  // A report as it came. What it says goes to clock, watchdog and losses.
  void Take(const base::Bytes& payload);
  // The same of a process of this PC that has ended.
  void Take(const LastWord& word);
  // The reason for which a process must not take part: the run ends by it, status 2. Empty: none is refused.
  const std::string& refusal() const { return refusal_; }
  // Nodes that were lost by their own word or by that of another PC, each once.
  std::vector<LostNode> TakeLost();
  // Another process will say that it is this node.
  void ExpectRestart(lockstep::NodeIndex node) { processes_[node] = {}; }

 private:
  struct ProcessIdentity {
    std::uint32_t incarnation = 0;
    std::string host;
    std::uint32_t pid = 0;
  };
  void Take(NamedReport& named);
  bool IsOfTheLost(const lockstep::Report& report);
  void Note(const lockstep::Report& report);
  base::Status MayTakePart(lockstep::NodeIndex node, const NamedReport& named);
  base::Status CheckOnce(lockstep::NodeIndex node, const NamedReport& named);

  ClockRun& run_;
  std::vector<Hello> expected_;  // by node: what this program would say as that node
  base::Digest world_ = 0;       // of the first node that has one
  std::uint64_t clock_id_;
  std::vector<ProcessIdentity> processes_;  // by node
  std::string refusal_;
  std::vector<LostNode> lost_;
};

}  // namespace rodeira::dds

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/runtime/dds/led_run.hpp"
#include "common/runtime/dds/wire.hpp"

namespace rodeira::dds {

// Who takes part: which reports count for the clock, which are passed over, and which end the run because two processes
// may not drive together.
class ClockGate {
 public:
  ClockGate(LedRun& run, const Hello& own, std::uint64_t clock_id)
      : run_(run), own_(own), clock_id_(clock_id), who_(run.roster.nodes().size()) {}

  // A report as it came. What it says goes to clock, watchdog and losses.
  void Take(const base::Bytes& payload);
  // A sentence where somebody must not take part: the run ends by it, status 2. Empty: nobody is refused.
  const std::string& refusal() const { return refusal_; }
  // "NODE TEXT" of processes whose loss another PC has said, each once.
  std::vector<std::string> TakeLost();
  // Another process will say that it is this node.
  void ExpectNextLife(lockstep::NodeIndex node) { who_[node] = {}; }

 private:
  struct Who {
    std::uint32_t incarnation = 0;
    std::string host;
    std::uint32_t pid = 0;
  };
  void Take(NamedReport& named);
  base::Status MayTakePart(lockstep::NodeIndex node, const NamedReport& named);
  base::Status CheckOnce(lockstep::NodeIndex node, const NamedReport& named);

  LedRun& run_;
  Hello own_;
  std::uint64_t clock_id_;
  std::vector<Who> who_;  // by node
  std::string refusal_;
  std::vector<std::string> lost_;
};

}  // namespace rodeira::dds

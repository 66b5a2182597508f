// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::lockstep {

// Names the node that stands still. Nodes report as a heartbeat; a silent one is dead, stopped or cut off; one that
// says that it has been computing one step for longer than its deadline hangs. Waiting is never a fault of the one that
// waits.
class Watchdog {
 public:
  // Bounds, each over 0.
  struct Settings {
    std::int64_t silence_ms = 600;    // longest time without a report
    std::int64_t deadline_ms = 5000;  // longest wall time of one step, where the node names none of its own
    std::int64_t start_ms = 60000;    // longest time until all are ready, and until a node has written what it made
  };
  // A node, and what is wrong with it.
  struct Fault {
    NodeIndex node = 0;
    std::string reason;   // a sentence that names the node
    int status = 1;       // exit status of the run: 2 where a person gave something wrong
    bool silent = false;  // it is not heard; its process may tell more
  };

  // The roster outlives it.
  Watchdog(const Roster& roster, const Settings& settings);
  // Every report, also one that says nothing new. now_ms: of one clock that never jumps.
  void Heard(const Report& report, std::int64_t now_ms);
  // The first fault in the roster's order; a node that failed by its own word comes first. A gap in the caller's own
  // calls (the clock itself was stopped, or had no processor for a sixth of the silence) is no node's silence and is
  // forgiven. While a node starts, its silence may last kStarting times as long: no node waits for it in a step, and a
  // PC that loads a large world has no processor to spare. `grant`: what the clock says. A node that has ended though
  // the run goes on is a fault, too.
  std::optional<Fault> Check(std::int64_t now_ms, const Grant& grant);
  // The node is started again and has as long as at the start. Until all are ready again no node's silence or
  // slowness counts: a node that writes to a killed process may be held up for a second (Fast DDS, shared memory). A
  // process that dies meanwhile is seen by its parent. A node that was held up may be so still when the new incarnation
  // is there already: until it has spoken again, its silence may last kHeldUp times as long.
  void ExpectRestart(NodeIndex node, std::int64_t now_ms);
  // Its fault is known and a person looks after it: it is named no more until it goes on.
  void Suspend(NodeIndex node);

 private:
  struct Incarnation {
    bool heard = false;
    std::int64_t last_ms = 0;
    Report report;
    bool excused = false;
    bool held_up = false;  // it has not spoken since a node was started again
  };
  static constexpr std::int64_t kHeldUp = 5;
  static constexpr std::int64_t kStarting = 5;

  const Roster& roster_;
  Settings settings_;
  std::vector<Incarnation> incarnations_;
  std::optional<std::int64_t> first_ms_;
  std::int64_t checked_ms_ = 0;
  bool all_ready_ = false;
  bool recovering_ = false;
};

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rodeira::cli {

// What the clock says line by line (common/runtime/dds/run_clock.cpp), gathered for the closing table.
struct RunReport {
  // A node's row of the closing table; times are wall time.
  struct Node {
    std::string name;
    std::uint64_t steps = 0;
    double mean_us = 0.0;
    double worst_us = 0.0;
    double apart_us = 0.0;  // wall time from step to step: the median,
    double apart_p99_us = 0.0;
    std::uint64_t server_calls = 0;
    bool cannot_save = false;  // its state
  };
  bool met = false;  // said by the follower of a clock on another PC
  bool ready = false;
  bool ended = false;
  bool ok = false;
  std::int64_t step = 0;  // progress; at the end the last step of the run
  double wall_s = 0.0;    // since the first grant
  double slipped_s = 0.0;
  double paused_s = 0.0;
  bool paused = false;         // now
  double pace = 0.0;           // now; 0: as fast as it can
  std::int64_t begun_ns = -1;  // when the first grant was given, on the monotonic clock; -1: not yet
  std::uint64_t clock_id = 0;
  std::uint64_t paced_steps = 0;  // granted at a pace, and of them those granted a step or more after they were due
  std::uint64_t late_steps = 0;
  double late_mean_s = 0.0;
  double late_worst_s = 0.0;
  std::string digest;
  std::string waiting_for;  // before ready
  std::vector<std::string> faults;
  std::vector<std::string> remarks;  // refused reports and strangers
  // What became of lost nodes: the newest that the clock asked for, and all that happened, for people.
  struct Restart {
    std::string node;
    std::uint32_t incarnation = 0;
    std::string reason;  // empty: it shares the process of another one
  };
  std::vector<Restart> wanted;  // taken by the part that starts processes
  std::vector<std::string> recovered;
  std::vector<std::string> paused_by;  // sentences
  std::vector<Node> nodes;

  // Takes one line; what it does not know it keeps as a remark.
  void Take(std::string_view line);
  // The closing table of a run, with a line break at the end of each line.
  std::string Table(double base_step_s, const std::string& recording) const;
};

}  // namespace rodeira::cli

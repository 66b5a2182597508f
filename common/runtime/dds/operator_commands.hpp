// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/runtime/dds/clock_losses.hpp"
#include "common/runtime/dds/clock_run.hpp"
#include "common/runtime/lockstep/command.hpp"

namespace rodeira::dds {

// What the operator asks of the clock, and its answers: "answer NUMBER ok|wrong|failed SENTENCE" for each "NUMBER
// COMMAND".
class OperatorCommands {
 public:
  // Both outlive it.
  OperatorCommands(ClockRun& run, ClockLosses& losses) : run_(run), losses_(losses) {}

  // Does each line in order and says its answer on standard output.
  void Do(const std::vector<std::string>& lines);
  // Ctrl-C in the run's terminal.
  void StopBySignal();
  // The run is to end; where it waits for a lost node it cannot do so in order.
  bool stop_asked() const { return stop_asked_; }

 private:
  base::Result<std::string> Do(const lockstep::Command& command);

  ClockRun& run_;
  ClockLosses& losses_;
  bool stop_asked_ = false;
};

}  // namespace rodeira::dds

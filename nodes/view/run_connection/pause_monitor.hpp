// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "common/runtime/launch/run_control_client.hpp"

namespace rodeira::nodes {

// Tells a window of a live run whether simulated time stands still, and why. When the pictures' time no longer
// advances, it queries the run's control socket.
class PauseMonitor {
 public:
  static constexpr double kStill_s = 0.5;  // without a new moment: time stands
  static constexpr double kAgain_s = 0.5;  // so often it asks why

  PauseMonitor() : run_control_(launch::RunControlClient::Open()) {}

  // Pause, or go on; one step. False where the clock is not on this PC.
  bool Toggle() { return Send("toggle"); }
  bool Step() { return Send("step"); }
  // At each picture: its simulated time and the wall's. A sentence for the window; empty while time goes on.
  std::string See(std::int64_t time_ns, double now_s);

 private:
  bool Send(const char* command);

  std::unique_ptr<launch::RunControlClient> run_control_;  // null: the clock is elsewhere
  std::int64_t seen_ns_ = -1;
  double moved_s_ = 0.0;  // when the simulated time was last seen to go on
  double asked_s_ = -1e9;
  std::string why_;  // "paused at …", as the clock says it; empty: it has not said so
};

}  // namespace rodeira::nodes

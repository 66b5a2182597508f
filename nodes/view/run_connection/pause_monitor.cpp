// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/run_connection/pause_monitor.hpp"

#include <string_view>

namespace rodeira::nodes {
namespace {

constexpr std::string_view kPaused = "ok paused";
constexpr const char* kKeys = "\nspace goes on, return is one step";

}  // namespace

bool PauseMonitor::Send(const char* command) {
  if (run_control_ != nullptr) run_control_->Send(command);
  return run_control_ != nullptr;
}

std::string PauseMonitor::See(std::int64_t time_ns, double now_s) {
  if (time_ns != seen_ns_) {
    seen_ns_ = time_ns;
    moved_s_ = now_s;
    why_.clear();
  }
  while (run_control_ != nullptr) {
    const auto answer = run_control_->Answer();
    if (!answer) break;
    why_ = answer->starts_with(kPaused) ? answer->substr(3, answer->find(';') - 3) : std::string();
  }
  if (now_s - moved_s_ < kStill_s) return why_.empty() ? "" : why_ + kKeys;
  if (run_control_ != nullptr && now_s - asked_s_ >= kAgain_s) {
    run_control_->Send("state");
    asked_s_ = now_s;
  }
  return why_.empty() ? "the run's time stands" : why_ + kKeys;
}

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/pacer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rodeira::lockstep {

Step Pacer::Due(std::int64_t now_ns) const {
  const double steps = static_cast<double>(now_ns - from_ns_) * pace_ / static_cast<double>(base_step_ns_);
  return from_step_ + static_cast<Step>(std::floor(std::max(steps, 0.0)));
}

void Pacer::Rebase(std::int64_t now_ns) {
  from_step_ = std::max(granted_, from_step_);
  from_ns_ = now_ns;
  slipped_since_grant_ns_ = 0;
}

Step Pacer::Limit(std::int64_t now_ns, Step window_limit) {
  if (!started_) {
    started_ = true;
    from_ns_ = now_ns;
  }
  if (paused_) return hold_;
  if (pace_ <= 0.0) return std::numeric_limits<Step>::max();
  const Step due = Due(now_ns);
  // A node that was started again computes what had been granted long ago: no time is dropped for that.
  const Step reachable = std::max(window_limit, granted_);
  if (due <= reachable) return std::min(due, window_limit);
  const auto slip_ns = static_cast<std::int64_t>(static_cast<double>((due - reachable) * base_step_ns_) / pace_);
  slipped_ns_ += slip_ns;
  slipped_since_grant_ns_ += slip_ns;
  ++slips_;
  // The part of a step that had passed by now stays passed.
  from_ns_ += slip_ns;
  return window_limit;
}

void Pacer::Granted(std::int64_t now_ns, Step through) {
  if (through <= granted_) return;
  late_ns_ = 0;
  if (!paused_ && pace_ > 0.0) {
    const double step_ns = static_cast<double>(base_step_ns_) / pace_;
    for (Step k = std::max(granted_ + 1, from_step_); k <= through; ++k) {
      const double due_ns = static_cast<double>(from_ns_) + static_cast<double>(k - from_step_) * step_ns;
      late_ns_ = std::max<std::int64_t>(now_ns - static_cast<std::int64_t>(due_ns) + slipped_since_grant_ns_, 0);
      ++lateness_.steps;
      if (static_cast<double>(late_ns_) >= step_ns) ++lateness_.late;
      lateness_.total_ns += late_ns_;
      lateness_.worst_ns = std::max(lateness_.worst_ns, late_ns_);
    }
  }
  slipped_since_grant_ns_ = 0;
  granted_ = through;
}

void Pacer::ContinueFrom(std::int64_t now_ns, Step through) {
  started_ = true;
  granted_ = from_step_ = through;
  from_ns_ = now_ns;
  if (paused_) hold_ = granted_;
}

void Pacer::Pause(std::int64_t now_ns) {
  hold_ = granted_;
  if (paused_) return;
  paused_ = true;
  paused_at_ns_ = now_ns;
}

void Pacer::Resume(std::int64_t now_ns) {
  if (!paused_) return;
  paused_ns_ += now_ns - paused_at_ns_;
  paused_ = false;
  Rebase(now_ns);
}

void Pacer::AllowSteps(Step steps) { hold_ += steps; }

void Pacer::SetPace(std::int64_t now_ns, double pace) {
  Rebase(now_ns);
  pace_ = pace;
}

std::int64_t Pacer::NextDueIn(std::int64_t now_ns) const {
  if (paused_ || pace_ <= 0.0) return 0;
  const double due_ns = static_cast<double>(Due(now_ns) + 1 - from_step_) * static_cast<double>(base_step_ns_) / pace_;
  return std::max<std::int64_t>(from_ns_ + static_cast<std::int64_t>(due_ns) - now_ns, 0);
}

}  // namespace rodeira::lockstep

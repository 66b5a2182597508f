#include "common/lockstep/pacer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rodeira::lockstep {

Step Pacer::Due(std::int64_t now_ns) const {
  if (paused_) return from_step_;
  const double steps = static_cast<double>(now_ns - from_ns_) * pace_ / static_cast<double>(base_step_ns_);
  return from_step_ + static_cast<Step>(std::floor(std::max(steps, 0.0)));
}

void Pacer::Rebase(std::int64_t now_ns) {
  from_step_ = Due(now_ns);
  from_ns_ = now_ns;
}

Step Pacer::Limit(std::int64_t now_ns, Step window_limit) {
  if (!started_) {
    started_ = true;
    from_ns_ = now_ns;
    from_step_ = 0;
  }
  if (paused_) return from_step_;
  if (pace_ <= 0.0) return std::numeric_limits<Step>::max();
  const Step due = Due(now_ns);
  if (due <= window_limit) return due;
  slipped_ns_ += static_cast<std::int64_t>(static_cast<double>((due - window_limit) * base_step_ns_) / pace_);
  ++slips_;
  from_step_ = window_limit;
  from_ns_ = now_ns;
  return window_limit;
}

void Pacer::Pause(std::int64_t now_ns) {
  if (paused_) return;
  if (pace_ > 0.0) Rebase(now_ns);
  paused_ = true;
}

void Pacer::Resume(std::int64_t now_ns) {
  if (!paused_) return;
  paused_ = false;
  from_ns_ = now_ns;
}

void Pacer::SetPace(std::int64_t now_ns, double pace) {
  if (pace_ > 0.0) Rebase(now_ns);
  pace_ = pace;
}

std::int64_t Pacer::NextDueIn(std::int64_t now_ns) const {
  if (paused_ || pace_ <= 0.0) return 0;
  const double due_ns = static_cast<double>(Due(now_ns) + 1 - from_step_) * static_cast<double>(base_step_ns_) / pace_;
  return std::max<std::int64_t>(from_ns_ + static_cast<std::int64_t>(due_ns) - now_ns, 0);
}

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/runtime/lockstep/step.hpp"

namespace rodeira::lockstep {

// How late the steps of a run were granted, measured against what the pace asked for at that moment: where time has
// slipped, the steps behind are due later by as much.
struct Lateness {
  std::uint64_t steps = 0;  // granted at a pace
  std::uint64_t late = 0;   // of them, when the step behind was already due, or later
  std::int64_t total_ns = 0;
  std::int64_t worst_ns = 0;
  double mean_ns() const { return steps == 0 ? 0.0 : static_cast<double>(total_ns) / static_cast<double>(steps); }
};

// How the wall time moves the grant (law L2). Pace 1 is real time, 0.5 slow motion, 0 as fast as possible.
class Pacer {
 public:
  Pacer(std::int64_t base_step_ns, double pace, Step first_step = 0)
      : base_step_ns_(base_step_ns), pace_(pace), from_step_(first_step) {}

  // The last step that may be granted at wall time `now_ns`. `window_limit` is what the nodes' progress allows: where
  // the wall has got further than that, time slips (the late part is forgotten, never caught up) and is counted. It may
  // lie behind what was granted already, while a node that was started again computes that once more: time stands then.
  Step Limit(std::int64_t now_ns, Step window_limit);
  // What was granted then. A pause, a step and a new pace begin there.
  void Granted(std::int64_t now_ns, Step through);

  // A run that was granted through `through` by another clock goes on now.
  void ContinueFrom(std::int64_t now_ns, Step through);

  void Pause(std::int64_t now_ns);  // also ends single steps that are not yet granted
  // The time of the pause is not caught up.
  void Resume(std::int64_t now_ns);
  void AllowSteps(Step steps);  // of a paused run: so many more
  // From now on; 0 is as fast as possible.
  void SetPace(std::int64_t now_ns, double pace);

  // Wall time from `now_ns` until the step behind Limit() is due; 0 where nothing is to be waited for.
  std::int64_t NextDueIn(std::int64_t now_ns) const;
  std::int64_t slipped_ns() const { return slipped_ns_; }  // wall time dropped, all together
  std::uint64_t slips() const { return slips_; }
  const Lateness& lateness() const { return lateness_; }
  std::int64_t late_ns() const { return late_ns_; }  // of the step granted last; 0 where none was due
  // Wall time in pauses, the present one included.
  std::int64_t PausedNs(std::int64_t now_ns) const { return paused_ns_ + (paused_ ? now_ns - paused_at_ns_ : 0); }
  double pace() const { return pace_; }
  bool paused() const { return paused_; }

 private:
  Step Due(std::int64_t now_ns) const;
  void Rebase(std::int64_t now_ns);

  std::int64_t base_step_ns_;
  double pace_;
  bool started_ = false;
  bool paused_ = false;
  std::int64_t from_ns_ = 0;  // wall time at which step from_step_ was due
  Step from_step_;
  Step granted_ = -1;
  Step hold_ = -1;  // the last step allowed while paused
  std::int64_t slipped_ns_ = 0;
  std::int64_t slipped_since_grant_ns_ = 0;
  std::uint64_t slips_ = 0;
  Lateness lateness_;
  std::int64_t late_ns_ = 0;
  std::int64_t paused_ns_ = 0;
  std::int64_t paused_at_ns_ = 0;
};

}  // namespace rodeira::lockstep

#pragma once

#include <cstdint>

#include "common/lockstep/step.hpp"

namespace rodeira::lockstep {

// How the wall time moves the grant (law L2). Pace 1 is real time, 0.5 slow motion, 0 as fast as possible.
class Pacer {
 public:
  Pacer(std::int64_t base_step_ns, double pace) : base_step_ns_(base_step_ns), pace_(pace) {}

  // The last step that may be granted at wall time `now_ns`. `window_limit` is what the nodes' progress allows: where
  // the wall has got further than that, time slips (the late part is forgotten, never caught up) and is counted.
  Step Limit(std::int64_t now_ns, Step window_limit);
  void Pause(std::int64_t now_ns);
  void Resume(std::int64_t now_ns);
  void SetPace(std::int64_t now_ns, double pace);

  // Wall time from `now_ns` until the step behind Limit() is due; 0 where nothing is to be waited for.
  std::int64_t NextDueIn(std::int64_t now_ns) const;
  std::int64_t slipped_ns() const { return slipped_ns_; }  // wall time given up, all together
  std::uint64_t slips() const { return slips_; }
  double pace() const { return pace_; }

 private:
  Step Due(std::int64_t now_ns) const;
  void Rebase(std::int64_t now_ns);

  std::int64_t base_step_ns_;
  double pace_;
  bool started_ = false;
  bool paused_ = false;
  std::int64_t from_ns_ = 0;  // wall time at which step from_step_ was due
  Step from_step_ = 0;
  std::int64_t slipped_ns_ = 0;
  std::uint64_t slips_ = 0;
};

}  // namespace rodeira::lockstep

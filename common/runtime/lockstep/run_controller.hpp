// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/clock.hpp"
#include "common/runtime/lockstep/command.hpp"
#include "common/runtime/lockstep/pacer.hpp"
#include "common/runtime/lockstep/run_log.hpp"

namespace rodeira::lockstep {

// Readings of the wall: one that never jumps, one that people and other recorders know, and one that also counts while
// the PC sleeps. Only the first decides; the second is a stamp.
struct Wall {
  std::int64_t monotonic_ns = 0;
  std::int64_t utc_ns = 0;  // since 1970
  std::int64_t awake_and_asleep_ns = 0;
};
// The wall now. Any thread.
Wall ReadWall();

// Leads a run: the clock grants, the pacer says when, the operator says otherwise, and the log keeps what happened.
// Pure logic: the owner brings the wall time and hands on grants and log.
class RunController {
 public:
  // The clock outlives it.
  RunController(Clock& clock, const Pacer& pacer, std::uint32_t incarnation = 0)
      : clock_(clock), pacer_(pacer), log_(incarnation), incarnation_(incarnation) {}

  // Another incarnation of a clock goes on with a run that began at `begin_ns` of the monotonic wall; the log says so
  // where it goes on.
  void ContinueRun(std::int64_t begin_ns, bool paused, const Wall& now);

  // The grant that holds now. The run begins at the first call with all nodes ready. A paced run in which this was not
  // called for kSleep_ns, because the PC slept or the process was stopped, is paused.
  Grant Update(const Wall& now);
  static constexpr std::int64_t kSleep_ns = 10'000'000'000;
  // What a person should read, each once; empty: nothing.
  std::string TakeWarning() { return std::exchange(warning_, {}); }
  // Does it, and says in a sentence what the run does now; failed where the run cannot (it has not begun, it ends).
  base::Result<std::string> Do(const Command& command, const Wall& now);
  // As the command kStop does, for a signal; before the first step nothing is left but to abort.
  void Stop(const Wall& now);
  // All nodes stop at once, for this reason.
  void Abort(const std::string& reason, const Wall& now);
  // What went wrong and does not end the run.
  void NoteFault(const std::string& what, const Wall& now) { Note(RemarkKind::kFault, what, now); }
  // All that computes has come to the last step: the log is complete.
  void CloseLog(const Wall& now);

  bool begun() const { return begun_; }
  const Pacer& pacer() const { return pacer_; }
  // How long to wait before the next Update where no node reports, in wall time; 0: nothing is due by itself.
  std::int64_t NextDueIn(const Wall& now) const;
  // Since the first grant; 0 before.
  std::int64_t RunNs(const Wall& now) const { return begun_ ? now.monotonic_ns - begin_ns_ : 0; }
  RunLog& log() { return log_; }

 private:
  std::uint32_t Note(RemarkKind kind, std::string text, const Wall& now);
  void PauseAfterSleep(const Wall& now);
  void Pause(const Wall& now);
  void Resume(const Wall& now);
  void SetPace(double pace, const Wall& now);
  std::string Here() const;  // "step 1234 (1.234 s)"
  std::string State() const;

  Clock& clock_;
  Pacer pacer_;
  RunLog log_;
  std::uint32_t incarnation_;
  bool begun_ = false;
  bool goes_on_ = false;
  std::int64_t begin_ns_ = 0;
  std::optional<Wall> moved_;  // the last call of Update
  std::string warning_;
};

}  // namespace rodeira::lockstep

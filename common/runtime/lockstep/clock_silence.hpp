// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rodeira::lockstep {

// When a node takes its clock for lost. A clock repeats its grant all the time: silence means that it was killed,
// stopped or cut off. Not counted is the time in which this process did not run, as under a debugger, and the time in
// which it could receive nothing because its receiving thread was held up, as by a step that hangs. Pure logic: the
// owner brings the wall time, in ms of any one clock, and locks.
class ClockSilence {
 public:
  // `longest_gap_ms`: between two calls of IsSilent; the process did not run in a longer one.
  ClockSilence(std::int64_t limit_ms, std::int64_t longest_gap_ms)
      : limit_ms_(limit_ms), longest_gap_ms_(longest_gap_ms) {}

  // A message of the clock has come.
  void Heard(std::int64_t now_ms);
  // Called about every 25 ms. `receives`: since the last call messages could be received. False before the first
  // message.
  bool IsSilent(std::int64_t now_ms, bool receives);

 private:
  std::int64_t limit_ms_;
  std::int64_t longest_gap_ms_;
  bool heard_ = false;
  std::int64_t silent_ms_ = 0;  // counted since the last message
  std::int64_t looked_ms_ = 0;  // the last call of IsSilent, or the message after it
};

}  // namespace rodeira::lockstep

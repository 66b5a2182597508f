// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/clock_silence.hpp"

namespace rodeira::lockstep {

void ClockSilence::Heard(std::int64_t now_ms) {
  heard_ = true;
  silent_ms_ = 0;
  looked_ms_ = now_ms;
}

bool ClockSilence::IsSilent(std::int64_t now_ms, bool receives) {
  if (!heard_) return false;
  const std::int64_t gap_ms = now_ms - looked_ms_;
  looked_ms_ = now_ms;
  const bool did_not_run = gap_ms > longest_gap_ms_;
  if (receives && !did_not_run) silent_ms_ += gap_ms;
  return silent_ms_ > limit_ms_;
}

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/playback/picture_pace.hpp"

namespace rodeira::scene {

double PicturePace::Next(double begin_s, const DisplayBeat& beat) {
  const bool is_known = beat.rate_Hz >= 20.0 && beat.rate_Hz <= 1000.0;
  const double period_s = 1.0 / (is_known ? beat.rate_Hz : kUnknown_Hz);
  if (beat.holds) {
    due_s_.reset();
    return begin_s + kHeldShare * period_s;
  }
  // From when it was due, not from when it began: a thread that wakes a little late each time does not become slower.
  const bool in_time = due_s_ && begin_s < *due_s_ + 0.5 * period_s;
  due_s_ = (in_time ? *due_s_ : begin_s) + period_s;
  return *due_s_;
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/playback/display_clock.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::scene {
namespace {

constexpr double kRateMemory_s = 1.0;  // on the wall
constexpr double kPhaseMemory_s = 0.4;
constexpr double kLate_s = 0.0015;  // so late a sample may come before the picture has to wait for it
constexpr double kPause_s = 0.5;    // longer without a sample says nothing about the rate

}  // namespace

void DisplayClock::Arrived(double wall_s, double sample_s, double interval_s) {
  if (!started_) {
    started_ = true;
    samples_s_ = walls_s_ = 0.1;  // real time, until more is known
    shown_wall_s_ = wall_s;
    shown_s_ = sample_s;
  } else if (const double passed = wall_s - arrived_wall_s_; passed < kPause_s) {
    // The ratio of two sums that forget alike: unlike the mean of ratios it does not care how unevenly samples come.
    const double keep = std::exp(-passed / kRateMemory_s);
    samples_s_ = keep * samples_s_ + sample_s - newest_s_;
    walls_s_ = keep * walls_s_ + passed;
    if (walls_s_ > 0.0) rate_ = samples_s_ / walls_s_;
  }
  arrived_wall_s_ = wall_s;
  newest_s_ = sample_s;
  interval_s_ = interval_s;
}

double DisplayClock::Now(double wall_s) {
  const double passed = wall_s - shown_wall_s_;
  shown_wall_s_ = wall_s;
  const double behind_s = interval_s_ + rate_ * kLate_s;
  const double wanted = newest_s_ - behind_s + std::min(rate_ * (wall_s - arrived_wall_s_), behind_s);
  double next = shown_s_ + rate_ * passed;
  next += (1.0 - std::exp(-passed / kPhaseMemory_s)) * (wanted - next);
  if (std::fabs(wanted - next) > kLost_s * std::max(rate_, 1.0))
    next = wanted;
  else
    next = std::max(next, shown_s_);
  shown_s_ = std::min(next, newest_s_);
  return shown_s_;
}

}  // namespace rodeira::scene

#include "common/scene/display_clock.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::scene {
namespace {

constexpr double kRateMemory_s = 0.5;   // on the wall
constexpr double kPhaseMemory_s = 0.25;
constexpr double kPause_s = 0.5;        // longer without a sample says nothing about the rate

}  // namespace

void DisplayClock::Arrived(double wall_s, double sample_s, double interval_s) {
  if (!started_) {
    started_ = true;
    shown_wall_s_ = wall_s;
    shown_s_ = sample_s;
  } else if (const double passed = wall_s - arrived_wall_s_; passed < kPause_s) {
    // Exponential forgetting by the wall time that passed; a burst (no time at all) counts fully with the next gap.
    const double weight = 1.0 - std::exp(-passed / kRateMemory_s);
    if (passed > 0.0) rate_ += weight * ((sample_s - newest_s_) / passed - rate_);
  }
  arrived_wall_s_ = wall_s;
  newest_s_ = sample_s;
  interval_s_ = interval_s;
}

double DisplayClock::Now(double wall_s) {
  const double passed = wall_s - shown_wall_s_;
  shown_wall_s_ = wall_s;
  const double since = std::min(rate_ * (wall_s - arrived_wall_s_), interval_s_);
  const double wanted = newest_s_ - interval_s_ + since;
  double next = shown_s_ + rate_ * passed;
  next += (1.0 - std::exp(-passed / kPhaseMemory_s)) * (wanted - next);
  if (std::fabs(wanted - next) > kLost_s * std::max(rate_, 1.0)) next = wanted;
  else next = std::max(next, shown_s_);
  shown_s_ = std::min(next, newest_s_);
  return shown_s_;
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::scene {

// Which time of the simulation to show at a time on the wall: one interval of samples and 1.5 ms on the wall behind the
// newest one, going on evenly although samples come unevenly. Never ahead of the newest sample, never backward, except
// that it starts anew where it was left behind by more than kLost_s. All in seconds.
class DisplayClock {
 public:
  static constexpr double kLost_s = 0.5;

  // A sample of the simulation's time `sample_s` came at `wall_s`, `interval_s` after the one before it.
  void Arrived(double wall_s, double sample_s, double interval_s);
  // The time to show. `wall_s` must not fall from call to call.
  double Now(double wall_s);
  // Seconds of simulation a second on the wall, as smoothed.
  double rate() const { return rate_; }

 private:
  bool started_ = false;
  double rate_ = 1.0;
  double samples_s_ = 0.0;  // sums over the last second or so
  double walls_s_ = 0.0;
  double arrived_wall_s_ = 0.0;
  double newest_s_ = 0.0;
  double interval_s_ = 0.0;
  double shown_wall_s_ = 0.0;
  double shown_s_ = 0.0;
};

}  // namespace rodeira::scene

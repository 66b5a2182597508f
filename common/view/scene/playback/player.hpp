// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rodeira::scene {

// Where in a recording one is, which way and how fast one goes on. Pure: it is told how much time passed on the wall.
// Whole nanoseconds of simulated time, so that as many equal ticks backward lead back to the very same times.
class Player {
 public:
  static constexpr double kSlowest = 0.1, kFastest = 10.0;  // of real time

  // A recording from 0 through `end_ns`, with a picture at each multiple of `picture_ns` (> 0) and at the end.
  Player(std::int64_t end_ns, std::int64_t picture_ns);

  std::int64_t now_ns() const { return now_ns_; }
  std::int64_t end_ns() const { return end_ns_; }
  bool paused() const { return paused_; }
  bool backward() const { return backward_; }
  double speed() const { return speed_; }

  // Time on the wall has passed. It stops at either end.
  void Advance(double wall_s);
  // Goes there, or to the nearer end; what it was doing it goes on doing.
  void Seek(std::int64_t time_ns);
  // To the next or, with -1, the previous picture, and stands still there.
  void StepPicture(int direction);
  // It stands still where it is.
  void Pause() { paused_ = true; }
  // Where it stands at the end towards which it plays, it begins again at the other one.
  void PlayOrPause();
  // Plays in the other direction from now on.
  void Reverse() { backward_ = !backward_; }
  // Held to [kSlowest, kFastest].
  void set_speed(double speed);
  // To the next of 0.1 0.2 0.5 1 2 5 10.
  void Faster();
  // To the one before.
  void Slower();

 private:
  std::int64_t end_ns_;
  std::int64_t picture_ns_;
  std::int64_t now_ns_ = 0;
  bool paused_ = false;
  bool backward_ = false;
  double speed_ = 1.0;
};

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/playback/player.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rodeira::scene {
namespace {

constexpr std::int64_t kPicture_ns = 20'000'000;
constexpr std::int64_t kEnd_ns = 30'010'000'000;  // not a picture's time

TEST(Player, GoesOnAsFastAsItIsTold) {
  Player player(kEnd_ns, kPicture_ns);
  for (const auto& [speed, expected_ns] :
       {std::pair(1.0, 500'000'000L), std::pair(0.1, 50'000'000L), std::pair(2.5, 1'250'000'000L)}) {
    player.Seek(1'000'000'000);
    player.set_speed(speed);
    for (int i = 0; i < 5; ++i) player.Advance(0.1);
    EXPECT_EQ(player.now_ns(), 1'000'000'000 + expected_ns);
  }
  player.Pause();
  player.Advance(100.0);
  EXPECT_EQ(player.now_ns(), 2'250'000'000);
}

TEST(Player, BackwardIsForwardReversed) {
  Player player(kEnd_ns, kPicture_ns);
  player.set_speed(0.7);
  player.Seek(3'141'592'653);
  std::vector<std::int64_t> there, back;
  const std::vector<double> ticks = {0.016, 0.017, 0.0163, 0.2, 0.0001, 0.016};  // as uneven as a display's
  for (const double tick_s : ticks) {
    there.push_back(player.now_ns());
    player.Advance(tick_s);
  }
  player.Reverse();
  for (std::size_t i = ticks.size(); i-- > 0;) {
    player.Advance(ticks[i]);
    back.insert(back.begin(), player.now_ns());
  }
  EXPECT_EQ(there, back);
}

TEST(Player, StopsAtBothEndsAndBeginsAgain) {
  Player player(kEnd_ns, kPicture_ns);
  player.Seek(kEnd_ns - 1'000'000);
  player.Advance(1.0);
  EXPECT_EQ(player.now_ns(), kEnd_ns);
  EXPECT_TRUE(player.paused());
  player.PlayOrPause();
  EXPECT_EQ(player.now_ns(), 0);
  EXPECT_FALSE(player.paused());
  player.Seek(5'000'000);
  player.Reverse();
  player.Advance(1.0);
  EXPECT_EQ(player.now_ns(), 0);
  EXPECT_TRUE(player.paused());
  player.PlayOrPause();
  EXPECT_EQ(player.now_ns(), kEnd_ns);
  player.Advance(1.0);
  EXPECT_EQ(player.now_ns(), kEnd_ns - 1'000'000'000);
}

TEST(Player, SeeksWithinTheRun) {
  Player player(kEnd_ns, kPicture_ns);
  player.Seek(-5);
  EXPECT_EQ(player.now_ns(), 0);
  player.Seek(kEnd_ns + 5);
  EXPECT_EQ(player.now_ns(), kEnd_ns);
  EXPECT_FALSE(player.paused()) << "a seek changes nothing else";
  Player empty(0, kPicture_ns);
  empty.Advance(1e9);
  EXPECT_EQ(empty.now_ns(), 0);
}

TEST(Player, StepsFromPictureToPicture) {
  Player player(kEnd_ns, kPicture_ns);
  player.Seek(50'000'000);  // between two
  player.StepPicture(1);
  EXPECT_EQ(player.now_ns(), 60'000'000);
  EXPECT_TRUE(player.paused());
  player.StepPicture(1);
  EXPECT_EQ(player.now_ns(), 80'000'000);
  player.Seek(50'000'000);
  player.StepPicture(-1);
  EXPECT_EQ(player.now_ns(), 40'000'000);
  player.StepPicture(-1);
  player.StepPicture(-1);
  player.StepPicture(-1);
  EXPECT_EQ(player.now_ns(), 0);
  player.Seek(30'000'000'000);
  player.StepPicture(1);
  EXPECT_EQ(player.now_ns(), kEnd_ns) << "the run's end is a picture too";
  player.StepPicture(1);
  EXPECT_EQ(player.now_ns(), kEnd_ns);
  player.StepPicture(-1);
  EXPECT_EQ(player.now_ns(), 30'000'000'000);
}

TEST(Player, HasSevenSpeedsAndAnyBetween) {
  Player player(kEnd_ns, kPicture_ns);
  std::vector<double> up;
  for (int i = 0; i < 4; ++i) {
    player.Faster();
    up.push_back(player.speed());
  }
  EXPECT_EQ(up, (std::vector<double>{2.0, 5.0, 10.0, 10.0}));
  std::vector<double> down;
  for (int i = 0; i < 7; ++i) {
    player.Slower();
    down.push_back(player.speed());
  }
  EXPECT_EQ(down, (std::vector<double>{5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.1}));
  player.set_speed(3.0);
  player.Faster();
  EXPECT_EQ(player.speed(), 5.0);
  player.set_speed(99.0);
  EXPECT_EQ(player.speed(), 10.0);
  player.set_speed(0.0);
  EXPECT_EQ(player.speed(), 0.1);
}

}  // namespace
}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/playback/display_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/base/random.hpp"

namespace rodeira::scene {
namespace {

struct Shown {
  double wall_s, sample_s, newest_s;
};

// Samples every 20 ms of the simulation at `rate`, each late by up to `jitter_s`; a display of 60 pictures a second.
std::vector<Shown> Watch(double rate, double jitter_s, double until_s, double pause_from_s = 1e9,
                         double pause_s = 0.0) {
  DisplayClock clock;
  std::vector<Shown> shown;
  double newest = 0.0;
  int k = 0;
  const auto arrival = [&](int i) {
    const double due = i * 0.02 / rate;
    return due + (due > pause_from_s ? pause_s : 0.0) +
           jitter_s * base::RandomUniform({7, static_cast<std::uint64_t>(i)});
  };
  for (double wall = 0.0; wall < until_s; wall += 1.0 / 60.0) {
    for (; arrival(k) <= wall; ++k) {
      clock.Arrived(arrival(k), newest = k * 0.02, k == 0 ? 0.0 : 0.02);
    }
    if (k > 0) shown.push_back({wall, clock.Now(wall), newest});
  }
  EXPECT_GT(shown.size(), static_cast<std::size_t>(59.0 * until_s) - 20);
  return shown;
}

TEST(DisplayClock, NeverAheadNeverBackward) {
  for (const double rate : {0.1, 0.5, 1.0, 7.0}) {
    const auto shown = Watch(rate, 0.012, 20.0, 8.0, 3.0);
    for (std::size_t i = 1; i < shown.size(); ++i) {
      EXPECT_LE(shown[i].sample_s, shown[i].newest_s + 1e-12);
      EXPECT_GE(shown[i].sample_s, shown[i - 1].sample_s - 1e-12) << rate << " at " << shown[i].wall_s;
    }
    EXPECT_NEAR(shown.back().sample_s, rate * 17.0, rate * 0.5) << "20 s with a pause of 3 s";
  }
}

TEST(DisplayClock, GoesEvenlyAlthoughSamplesComeUnevenly) {
  for (const double rate : {0.5, 1.0, 2.0}) {
    // Late by up to 40 % of the time between two; more, and one period behind is not enough to hide it.
    const auto shown = Watch(rate, 0.008 / rate, 20.0);
    double worst = 0.0;
    int compared = 0;
    for (std::size_t i = 1; i < shown.size(); ++i) {
      if (shown[i].wall_s < 10.0) continue;  // settled
      ++compared;
      const double step = shown[i].sample_s - shown[i - 1].sample_s;
      worst = std::max(worst, std::fabs(step - rate / 60.0));
    }
    // Straight from the arrivals the error would be a whole sample (20 ms); a person sees far less than 4 ms.
    EXPECT_LT(worst, 0.004) << rate;
    EXPECT_GT(compared, 500) << rate << ": 60 a second for 10 s";
  }
}

TEST(DisplayClock, StaysAboutOnePeriodBehind) {
  const auto shown = Watch(1.0, 0.0, 20.0);
  for (const Shown& at : shown) {
    if (at.wall_s < 10.0) continue;
    const double behind = at.wall_s - at.sample_s;  // the simulation's time is the wall's here
    EXPECT_GT(behind, 0.005);
    EXPECT_LT(behind, 0.04);
  }
}

TEST(DisplayClock, StandsDuringAPauseAndFindsBack) {
  const auto shown = Watch(1.0, 0.0, 30.0, 10.0, 5.0);
  double at_pause = 0.0;
  for (const Shown& at : shown) {
    if (at.wall_s < 11.0) at_pause = at.sample_s;
    if (at.wall_s > 11.0 && at.wall_s < 14.9) {
      EXPECT_NEAR(at.sample_s, at_pause, 0.02);
    }
    if (at.wall_s > 20.0) {
      EXPECT_NEAR(at.wall_s - 5.0 - at.sample_s, 0.02, 0.02);
    }
  }
  EXPECT_NEAR(at_pause, 10.0, 0.05);
}

}  // namespace
}  // namespace rodeira::scene

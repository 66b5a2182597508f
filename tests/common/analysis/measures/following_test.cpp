// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/following.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kOmega = 2.0 * std::numbers::pi / 32.0;

FollowingOptions NineSegments() {
  FollowingOptions options;
  options.segment_s = 128.0;
  options.frequency_hz = 1.0 / 32.0;
  return options;
}

// Own speed V + G A sin(w (t - tau)): coherence 1, modulus G, delay tau. 640 s at 4 Hz are 9 segments.
TEST(Following, AFollowerOfASineHasItsGainAndDelay) {
  const auto leader = Sampled(640.0, 4.0, [](double t) { return 20.0 + 2.0 * std::sin(kOmega * t); });
  const auto own = Sampled(640.0, 4.0, [](double t) { return 19.0 + 1.8 * std::sin(kOmega * (t - 2.0)); });
  const Following f = FollowLeader(leader, own, 4.0, NineSegments());
  EXPECT_NEAR(*f.coherence.value, 1.0, 1e-4);
  EXPECT_NEAR(*f.modulus.value, 0.9, 1e-4);
  EXPECT_NEAR(*f.delay.value, 2.0, 1e-3);
  EXPECT_NEAR(*f.phase.value, -2.0 * kOmega, 1e-3);
  EXPECT_EQ(f.delay.options[1], (UsedOption{"segments", "9"}));
  // At 100 Hz, and with the frequency left to be found, it is the same.
  const auto fast_leader = Sampled(640.0, 100.0, [](double t) { return 20.0 + 2.0 * std::sin(kOmega * t); });
  const auto fast_own = Sampled(640.0, 100.0, [](double t) { return 19.0 + 1.8 * std::sin(kOmega * (t - 2.0)); });
  const Following g = FollowLeader(fast_leader, fast_own, 100.0, NineSegments());
  EXPECT_NEAR(*g.modulus.value, 0.9, 1e-3);
  EXPECT_NEAR(*g.delay.value, 2.0, 1e-2);
}

// Noise lowers the coherence; one segment alone says 1 whatever the noise is, and is refused.
TEST(Following, OneSegmentIsRefused) {
  std::mt19937 draw(5);
  std::normal_distribution<double> noise(0.0, 5.0);
  const auto leader = Sampled(640.0, 4.0, [](double t) { return 20.0 + 2.0 * std::sin(kOmega * t); });
  const auto own = Sampled(640.0, 4.0, [&](double t) { return 19.0 + 1.8 * std::sin(kOmega * t) + noise(draw); });
  const Following f = FollowLeader(leader, own, 4.0, NineSegments());
  EXPECT_LT(*f.coherence.value, 0.99);
  EXPECT_GT(*f.coherence.value, 0.75);
  FollowingOptions one = NineSegments();
  one.segment_s = 640.0;
  EXPECT_FALSE(FollowLeader(leader, own, 4.0, one).coherence.value);
  one.min_segments = 1;
  EXPECT_NEAR(*FollowLeader(leader, own, 4.0, one).coherence.value, 1.0, 1e-9);
  const std::vector<double> steady(2560, 20.0);
  EXPECT_EQ(FollowLeader(steady, own, 4.0, NineSegments()).delay.reason, "the leader's speed does not vary");
}

}  // namespace
}  // namespace rodeira::measures

// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/following.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <random>

#include "common/driving/driver/idm.hpp"
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

// White noise of 5 m/s on the own speed, 9 Hann segments half overlapped: with S = (A/2)^2 (sum w)^2 of the sine and
// N = sigma^2 sum w^2 the mean of the coherence is (S + N (1 + 2 8/9 / 6) / 9) / (S + N). One draw with 0.946 is known.
TEST(Following, NoiseLowersTheCoherenceByItsShare) {
  constexpr double kSine = 0.81 * 256.0 * 256.0, kNoise = 25.0 * 192.0;
  const double expected = (kSine + kNoise * (1.0 + 16.0 / 9.0 / 6.0) / 9.0) / (kSine + kNoise);
  const auto leader = Sampled(640.0, 4.0, [](double t) { return 20.0 + 2.0 * std::sin(kOmega * t); });
  std::mt19937_64 draw(1);
  std::normal_distribution<double> noise(0.0, 5.0);
  double sum = 0.0, squares = 0.0;
  constexpr int kDraws = 300;
  for (int i = 0; i < kDraws; ++i) {
    const auto own = Sampled(640.0, 4.0, [&](double t) { return 19.0 + 1.8 * std::sin(kOmega * t) + noise(draw); });
    const double coherence = *FollowLeader(leader, own, 4.0, NineSegments()).coherence.value;
    sum += coherence;
    squares += coherence * coherence;
  }
  const double mean = sum / kDraws, deviation = std::sqrt(squares / kDraws - mean * mean);
  EXPECT_NEAR(mean, expected, 4.0 * deviation / std::sqrt(kDraws) + 0.002);
  EXPECT_NEAR(0.946, mean, 2.0 * deviation);
}

// A follower by the IDM behind a leader of a small sine: linearised about the equilibrium, with the law's slopes f_s,
// f_v, f_l to gap, own and leader's speed, the transfer function is (f_s + i w f_l) / (f_s - w^2 - i w f_v).
TEST(Following, AnIdmFollowerHasTheGainAndDelayOfItsLinearisation) {
  const driver::IdmSettings idm;
  constexpr double kDesired = 30.0, kStep_s = 0.01, kTiny = 1e-4;
  for (const double mean_mps : {12.0, 20.0, 25.0}) {
    const double gap_m = driver::IdmEquilibriumGap(idm, mean_mps, kDesired);
    const auto law = [&](double gap, double own, double leader) {
      return driver::IdmAcceleration(idm, own, kDesired, gap, leader);
    };
    ASSERT_NEAR(law(gap_m, mean_mps, mean_mps), 0.0, 1e-6);
    const double fs = (law(gap_m + kTiny, mean_mps, mean_mps) - law(gap_m - kTiny, mean_mps, mean_mps)) / (2.0 * kTiny);
    const double fv = (law(gap_m, mean_mps + kTiny, mean_mps) - law(gap_m, mean_mps - kTiny, mean_mps)) / (2.0 * kTiny);
    const double fl = (law(gap_m, mean_mps, mean_mps + kTiny) - law(gap_m, mean_mps, mean_mps - kTiny)) / (2.0 * kTiny);
    const std::complex<double> transfer =
        std::complex<double>(fs, kOmega * fl) / std::complex<double>(fs - kOmega * kOmega, -kOmega * fv);
    std::vector<double> leader, own;
    double v = mean_mps, gap = gap_m;
    for (int k = 0; k < 104'000; ++k) {  // the first 400 s are the transient
      const double now = mean_mps + 0.1 * std::sin(kOmega * kStep_s * k);
      if (k >= 40'000 && k % 25 == 0) leader.push_back(now), own.push_back(v);
      const double next = mean_mps + 0.1 * std::sin(kOmega * kStep_s * (k + 1));
      // Heun's method.
      const double a = law(gap, v, now), b = law(gap + kStep_s * (now - v), v + kStep_s * a, next);
      const double to = v + 0.5 * kStep_s * (a + b);
      gap += 0.5 * kStep_s * (now - v + next - to);
      v = to;
    }
    const Following f = FollowLeader(leader, own, 4.0, NineSegments());
    EXPECT_NEAR(*f.modulus.value, std::abs(transfer), 2e-3) << mean_mps;
    EXPECT_NEAR(*f.delay.value, -std::arg(transfer) / kOmega, 0.02) << mean_mps;
    EXPECT_NEAR(*f.coherence.value, 1.0, 1e-3);
  }
}

}  // namespace
}  // namespace rodeira::measures

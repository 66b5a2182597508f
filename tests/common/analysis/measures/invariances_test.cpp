// SPDX-License-Identifier: Apache-2.0
// What must not change a measure: left and right exchanged, another beginning of time, an interval in parts, a lower
// sample rate. The signals are drawn.
#include <gtest/gtest.h>

#include <random>
#include <rapidcheck.h>

#include "common/analysis/measures/conflict.hpp"
#include "common/analysis/measures/lane_position.hpp"
#include "common/analysis/measures/reversals.hpp"
#include "common/analysis/measures/steering.hpp"
#include "common/analysis/measures/steering_entropy.hpp"
#include "common/analysis/measures/time_to_line.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

// A wandering signal without content above some 2 Hz, as of a driver.
std::vector<double> Wander(std::uint64_t seed, double seconds, double rate_hz) {
  std::mt19937_64 draw(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  struct Wave {
    double amplitude, frequency, phase;
  };
  std::vector<Wave> waves;
  for (int i = 0; i < 12; ++i) {
    const double frequency = 0.02 + 1.5 * share(draw) * share(draw);
    waves.push_back({(0.5 + share(draw)) / (0.3 + frequency), frequency, 6.28 * share(draw)});
  }
  return Sampled(seconds, rate_hz, [&](double t) {
    double sum = 0.0;
    for (const Wave& w : waves) sum += w.amplitude * std::sin(2.0 * std::numbers::pi * w.frequency * t + w.phase);
    return sum;
  });
}

std::vector<double> Mirrored(std::vector<double> x) {
  for (double& value : x) value = -value;
  return x;
}

TEST(Invariances, LeftAndRightExchanged) {
  EXPECT_TRUE(rc::check("mirror", [](std::uint64_t seed) {
    const auto x = Wander(seed, 90.0, 50.0), baseline = Wander(seed + 1, 95.0, 50.0);
    const auto m = Mirrored(x), mirrored_baseline = Mirrored(baseline);
    RC_ASSERT(ReversalRate(x, 50.0, {}).value == ReversalRate(m, 50.0, {}).value);
    RC_ASSERT(MeanSteeringRate(x, 50.0).value == MeanSteeringRate(m, 50.0).value);
    RC_ASSERT(std::abs(*SteeringEntropy1999(x, baseline, 50.0).value -
                       *SteeringEntropy1999(m, mirrored_baseline, 50.0).value) < 1e-9);
    const std::vector<std::int32_t> lane(x.size(), 0);
    RC_ASSERT(std::abs(*Sdlp({x, lane}, {}).value - *Sdlp({m, lane}, {}).value) < 1e-12);
    const auto y = static_cast<double>(seed % 1000) * 1e-3 - 0.5;
    const LaneApproach a{y, 0.03 * y + 0.01, 20.0, 0.02 - 0.03 * y, 3.5, 0.002, 2.0, 1.8};
    const LaneApproach b{-y, -0.03 * y - 0.01, 20.0, -0.02 + 0.03 * y, 3.5, -0.002, 2.0, 1.8};
    const double ta = TrigonometricTlc_s(a), tb = TrigonometricTlc_s(b);
    RC_ASSERT((std::isnan(ta) ? std::isnan(tb) : std::abs(ta - tb) < 1e-9));
  }));
}

// A constant on an angle or a position changes no deviation, rate or count.
TEST(Invariances, AnOffsetChangesNoDeviation) {
  EXPECT_TRUE(rc::check("offset", [](std::uint64_t seed) {
    const auto x = Wander(seed, 60.0, 50.0);
    auto moved = x;
    for (double& value : moved) value += 7.25;
    RC_ASSERT(ReversalRate(x, 50.0, {}).value == ReversalRate(moved, 50.0, {}).value);
    RC_ASSERT(std::abs(*Deviation(x, Denominator::kN) - *Deviation(moved, Denominator::kN)) < 1e-9);
  }));
}

// Parts pool to the whole: sums of squares about the common mean, counts of half-open intervals.
TEST(Invariances, AnIntervalInParts) {
  EXPECT_TRUE(rc::check("split and pool", [](std::uint64_t seed) {
    const auto x = Wander(seed, 40.0, 50.0);
    const std::size_t cut = 1 + seed % (x.size() - 1);
    const Series first = Series(x).first(cut), second = Series(x).subspan(cut);
    const double mean =
        (static_cast<double>(cut) * *Mean(first) + static_cast<double>(x.size() - cut) * *Mean(second)) /
        static_cast<double>(x.size());
    RC_ASSERT(std::abs(mean - *Mean(x)) < 1e-9);
    const std::vector<double> own(x.size(), 20.0), leader(x.size(), 15.0);
    std::vector<double> gap(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) gap[i] = 12.0 + x[i];
    const auto ttc = TtcSeries(gap, own, leader);
    const auto exposed = [&](std::size_t from, std::size_t n) {
      return *TimeExposedTtc(Series(ttc).subspan(from, n), Series(gap).subspan(from, n), 50.0, 2.5).value;
    };
    RC_ASSERT(std::abs(exposed(0, x.size()) - exposed(0, cut) - exposed(cut, x.size() - cut)) < 1e-9);
    // Lanes: the episodes are the parts.
    std::vector<std::int32_t> lane(x.size(), 0);
    for (std::size_t i = cut; i < lane.size(); ++i) lane[i] = 1;
    const auto pooled = Sdlp({x, lane}, {.denominator = Denominator::kN});
    const double a = *Deviation(first, Denominator::kN), b = *Deviation(second, Denominator::kN);
    const double n = static_cast<double>(x.size());
    const double expected = std::sqrt((static_cast<double>(cut) * a * a + (n - static_cast<double>(cut)) * b * b) / n);
    RC_ASSERT(std::abs(*pooled.value - expected) < 1e-9);
  }));
}

// 1 kHz and 100 Hz: means, deviations and shares within 1 %, counts within one. With ends that are
// extended by one number of samples at every rate there are two reversals more at seeds 562, 1362 and 1639.
TEST(Invariances, DecimatedToAHundredHertz) {
  const auto holds = [](std::uint64_t seed) {
    const auto fast = Wander(seed, 40.0, 1000.0);
    const auto slow = Decimate(fast, 10);
    const auto close = [](double a, double b) { return std::abs(a - b) <= 0.01 * std::abs(a); };
    const auto counted = [](Series x, double rate_hz) {
      return *ReversalRate(x, rate_hz, {}).value * static_cast<double>(x.size() - 1) / rate_hz / 60.0;
    };
    return slow.size() == fast.size() / 10 &&
           close(*Deviation(fast, Denominator::kN), *Deviation(slow, Denominator::kN)) &&
           close(*MeanSteeringRate(fast, 1000.0).value, *MeanSteeringRate(slow, 100.0).value) &&
           std::abs(counted(fast, 1000.0) - counted(slow, 100.0)) < 1.5;
  };
  constexpr std::uint64_t kSeeds = 200;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) EXPECT_TRUE(holds(seed)) << seed;
  for (const std::uint64_t seed : {562u, 1362u, 1639u}) EXPECT_TRUE(holds(seed)) << seed;
  EXPECT_TRUE(rc::check("decimate", [&](std::uint64_t seed) { RC_ASSERT(holds(seed)); }));
}

}  // namespace
}  // namespace rodeira::measures

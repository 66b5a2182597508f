// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/reversals.hpp"

#include <gtest/gtest.h>

#include "tests/common/analysis/measures/mat_file.hpp"
#include "tests/common/analysis/measures/signals.hpp"
#include "tests/tree.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 30.0;

// The recordings of Markkula & Engstroem, evaluated by their own program (unchanged, in Octave).
TEST(Reversals, TheAuthorsRecordingsHaveTheAuthorsCounts) {
  const auto path = std::filesystem::path(SourceDir()) / "../shared/data/measures/TestSequences.mat";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "the authors' steering recordings are not here: " << path;
  const auto signals = ReadMatFile(path);
  const auto rate = [&](const char* task, const ReversalOptions& options) {
    const auto found = signals.find("TestSequence_CurvedRoad" + std::string(task) + "_deg");
    if (found == signals.end() || found->second.size() != 751u) return -1.0;
    return *ReversalRate(found->second, kRate, options).value;
  };
  for (const double padding : {kPaddingOfAuthors_s, static_cast<double>(kPaddingOfSciPy) / kRate}) {
    EXPECT_NEAR(rate("Baseline", {0.6, 3.0, padding}), 12.0, 1e-9);
    EXPECT_NEAR(rate("VisualTask", {0.6, 3.0, padding}), 19.2, 1e-9);
    EXPECT_NEAR(rate("Baseline", {2.0, 0.1, padding}), 64.8, 1e-9);
  }
}

std::size_t CountOfSine(double amplitude_deg, double frequency_hz, const ReversalOptions& options) {
  const auto wheel = SineWave(amplitude_deg, frequency_hz, 60.0, kRate);
  const Measure rate = ReversalRate(wheel, kRate, options);
  return static_cast<std::size_t>(std::llround(*rate.value * static_cast<double>(wheel.size() - 1) / kRate / 60.0));
}

// 60 s of a sine: a swing is 2 A / (1 + (tan(pi f / fs) / tan(pi fc / fs))^4). 0.2 Hz has 12 periods, 24 swings; with
// 2 degrees the first half swing is too small, with 1.4 degrees all are. 1.2 Hz has 144 swings of 0.12 times A; what is
// left of 20 degrees, and the three of 144 that are too small, come from the edge of a filter without padding.
TEST(Reversals, SinesHaveTheirSwings) {
  EXPECT_EQ(CountOfSine(5.0, 0.2, {}), 24u);
  EXPECT_EQ(CountOfSine(2.0, 0.2, {}), 23u);
  EXPECT_EQ(CountOfSine(1.4, 0.2, {}), 0u);
  EXPECT_EQ(CountOfSine(30.0, 1.2, {.padding_s = 0.0}), 141u);
  EXPECT_EQ(CountOfSine(20.0, 1.2, {.padding_s = 0.0}), 1u);
}

// By hand: a reversal is larger than the gap, and the search goes on from its end.
TEST(Reversals, StepsByHand) {
  EXPECT_EQ(CountReversals(std::vector<double>{0.0, 3.0, 0.0}, 3.0), 0u);
  EXPECT_EQ(CountReversals(std::vector<double>{0.0, 3.1, 0.0}, 3.0), 1u);  // the last sample is no stationary point
  EXPECT_EQ(CountReversals(std::vector<double>{0.0, 3.1, 0.0, 1.0}, 3.0), 2u);
  EXPECT_EQ(CountReversals(std::vector<double>{0.0, 2.0, 1.0, 3.5, 2.5, 5.0}, 3.0), 1u);  // one long way up
  EXPECT_EQ(CountReversals(std::vector<double>{0.0, 0.0, 0.0}, 0.1), 0u);
}

TEST(Reversals, MissingSamplesAndShortSeries) {
  const auto wheel = SineWave(5.0, 0.2, 60.0, kRate);
  auto hole = wheel;
  for (std::size_t i = 850; i < 950; ++i) hole[i] = kMissing;
  const Measure rate = ReversalRate(hole, kRate, {});
  EXPECT_EQ(rate.n, 1700u);
  EXPECT_NEAR(*rate.value, 24.0, 3.0);
  EXPECT_FALSE(ReversalRate(Series(wheel).first(6), kRate, {}).value);
  EXPECT_FALSE(ReversalRate(wheel, 1.0, {}).value) << "no filter of 0.6 Hz at 1 Hz";
}

}  // namespace
}  // namespace rodeira::measures

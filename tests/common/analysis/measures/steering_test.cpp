// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/steering.hpp"

#include <gtest/gtest.h>

#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

// |rate| of A sin(2 pi f t) has the mean 4 A f; it is below r for the share 2/pi asin(r / (2 pi f A)).
TEST(Steering, RatesOfASine) {
  const auto wheel = SineWave(6.0, 0.1, 100.0, 100.0);
  EXPECT_NEAR(*MeanSteeringRate(wheel, 100.0).value, 4.0 * 6.0 * 0.1, 1e-4);
  const double share = 2.0 / std::numbers::pi * std::asin(1.0 / (2.0 * std::numbers::pi * 0.1 * 6.0));
  EXPECT_NEAR(*SteeringStillShare(wheel, 100.0).value, share, 0.002);
}

// Two sines: powers a^2 at 0.15 Hz and b^2 at 0.45 Hz, b^2 / (a^2 + b^2) of it in the band.
TEST(Steering, HighFrequencyShareOfTwoSines) {
  const auto wheel = Sampled(300.0, 100.0, [](double t) {
    return 3.0 * std::sin(2.0 * std::numbers::pi * 0.15 * t) + 1.5 * std::sin(2.0 * std::numbers::pi * 0.45 * t) + 10.0;
  });
  const Measure hfc = HighFrequencySteering(wheel, 100.0, {});
  EXPECT_NEAR(*hfc.value, 2.25 / 11.25, 1e-3);
  EXPECT_FALSE(HighFrequencySteering(Series(wheel).first(500), 100.0, {}).value);
  EXPECT_FALSE(HighFrequencySteering(std::vector<double>(30000, 0.0), 100.0, {}).value);
}

}  // namespace
}  // namespace rodeira::measures

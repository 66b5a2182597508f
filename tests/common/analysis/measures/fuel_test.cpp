// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/fuel.hpp"

#include <gtest/gtest.h>

#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0;

// 2 g/s at 20 m/s are 0.1 g/m, 10 kg in 100 km.
TEST(Fuel, OfAConstantRate) {
  const auto burnt = Sampled(60.0, kRate, [](double t) { return 0.3 + 0.002 * t; });
  const auto speed = Sampled(60.0, kRate, [](double) { return 20.0; });
  const double seconds = static_cast<double>(burnt.size() - 1) / kRate;
  EXPECT_NEAR(*FuelUsed(burnt, {}).value, 0.002 * seconds / 0.745, 1e-12);
  EXPECT_NEAR(*FuelOverDistance(burnt, speed, kRate, {}).value, 10.0 / 0.745, 1e-9);
  EXPECT_NEAR(*FuelOverDistance(burnt, speed, kRate, {.density_kgpl = 0.832}).value, 10.0 / 0.832, 1e-9);
}

// In reverse the way counts as forward.
TEST(Fuel, InReverse) {
  const auto burnt = Sampled(10.0, kRate, [](double t) { return 0.001 * t; });
  const auto speed = Sampled(10.0, kRate, [](double) { return -2.0; });
  EXPECT_NEAR(*FuelOverDistance(burnt, speed, kRate, {}).value, 50.0 / 0.745, 1e-9);
}

// What was burnt in a gap of the samples is in it; a count that begins again counts nothing.
TEST(Fuel, OfAGapAndOfANewCount) {
  const std::vector<double> gap{1.0, 1.1, kMissing, kMissing, 1.5};
  EXPECT_NEAR(*FuelUsed(gap, {}).value, 0.5 / 0.745, 1e-12);
  EXPECT_DOUBLE_EQ(FuelUsed(gap, {}).valid_share, 0.6);
  EXPECT_NEAR(*FuelUsed(std::vector<double>{1.0, 1.2, 0.0, 0.1}, {}).value, 0.3 / 0.745, 1e-12);
}

TEST(Fuel, IsMissingWithItsReason) {
  const std::vector<double> none(5, kMissing), still(5, 0.0), burnt{0.0, 0.1, 0.2, 0.3, 0.4};
  const Measure unknown = FuelUsed(none, {});
  EXPECT_FALSE(unknown.value);
  EXPECT_FALSE(unknown.reason.empty());
  const Measure at_rest = FuelOverDistance(burnt, still, kRate, {});
  EXPECT_FALSE(at_rest.value);
  EXPECT_FALSE(at_rest.reason.empty());
  EXPECT_EQ(at_rest.unit, "l/100km");
}

}  // namespace
}  // namespace rodeira::measures

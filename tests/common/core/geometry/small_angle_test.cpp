// SPDX-License-Identifier: Apache-2.0
// The short series against the library, with functions that are right to half a bit or a little more.
#include "common/core/geometry/small_angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/core/geometry/small_arc_tangent.hpp"

namespace rodeira::geometry {
namespace {

double Bit(double value) {
  return std::nextafter(std::fabs(value), std::numeric_limits<double>::infinity()) - std::fabs(value);
}

TEST(SmallAngle, SineCosineAndArcTangentAreRightToABit) {
  for (int i = -3000; i <= 3000; ++i) {
    const double x = i * 1e-4;
    ASSERT_NEAR(SmallSine(x), std::sin(x), Bit(std::sin(x))) << x;
    ASSERT_NEAR(SmallCosine(x), std::cos(x), Bit(std::cos(x))) << x;
    if (std::fabs(x) <= kSmallTangent) {
      ASSERT_NEAR(SmallArcTangent(x), std::atan(x), Bit(std::atan(x))) << x;
    }
  }
}

TEST(SmallAngle, LargerOnesAreTheLibrarys) {
  for (const double x : {-2.5, -0.31, 0.31, 1.0, 100.0}) {
    EXPECT_EQ(SineOf(x), std::sin(x));
    EXPECT_EQ(CosineOf(x), std::cos(x));
  }
  EXPECT_EQ(SineOf(0.25), SmallSine(0.25));
  EXPECT_TRUE(std::isnan(SineOf(std::nan(""))) && std::isnan(CosineOf(std::nan(""))));
}

}  // namespace
}  // namespace rodeira::geometry

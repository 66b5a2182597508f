// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rodeira::geometry {
namespace {

TEST(WrapAngle, KeepsTheDirectionWithinHalfATurn) {
  EXPECT_EQ(WrapAngle(kPi), kPi);
  EXPECT_EQ(WrapAngle(-kPi), kPi);
  EXPECT_EQ(WrapAngle(0.25), 0.25);
  for (double angle = -50.0; angle < 50.0; angle += 0.37) {
    const double wrapped = WrapAngle(angle);
    EXPECT_GT(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-13);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-13);
  }
}

}  // namespace
}  // namespace rodeira::geometry

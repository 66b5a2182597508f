// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/encroachment.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace rodeira::measures {
namespace {

constexpr double kRate = 50.0;

// Straight on from `start` for `seconds`.
std::vector<Footprint> Straight(Eigen::Vector2d start, double heading, double speed, double seconds, double length,
                                double width) {
  std::vector<Footprint> path;
  const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
  for (int i = 0; i < static_cast<int>(seconds * kRate); ++i)
    path.push_back({start + speed * i / kRate * ahead, heading, length, width});
  return path;
}

// Two cars at right angles: with fronts at d1 and d2 before the crossing of the middle lines the first one's rear
// leaves the other's band after (d1 + w/2 + L) / v1, the other's front comes to the first one's after (d2 - w/2) / v2.
TEST(Encroachment, TwoCarsAtRightAngles) {
  constexpr double kLength = 4.5, kWidth = 1.8;
  for (const double d2 : {40.0, 31.0, 60.0}) {
    const auto a = Straight({-20.0 - kLength / 2.0, 0.0}, 0.0, 10.0, 8.0, kLength, kWidth);
    const auto b = Straight({0.0, -d2 - kLength / 2.0}, std::numbers::pi / 2.0, 12.0, 8.0, kLength, kWidth);
    const double expected = (d2 - kWidth / 2.0) / 12.0 - (20.0 + kWidth / 2.0 + kLength) / 10.0;
    const Measure pet = PostEncroachmentTime(a, b, kRate);
    ASSERT_TRUE(pet.value) << pet.reason;
    EXPECT_NEAR(*pet.value, expected, 1e-6) << d2;  // the one of 31 m is negative: both are there at a time
    EXPECT_NEAR(*PostEncroachmentTime(b, a, kRate).value, expected, 1e-6) << "in any order";
  }
}

TEST(Encroachment, PathsWithoutACommonArea) {
  const auto a = Straight({0.0, 0.0}, 0.0, 10.0, 3.0, 4.5, 1.8);
  const auto b = Straight({0.0, 3.5}, 0.0, 10.0, 3.0, 4.5, 1.8);
  EXPECT_EQ(PostEncroachmentTime(a, b, kRate).reason, "the paths have no common area");
  // The first one stops on the crossing.
  auto stays = Straight({-10.0, 0.0}, 0.0, 10.0, 1.0, 4.5, 1.8);
  while (stays.size() < 400) stays.push_back(stays.back());
  const auto crosses = Straight({0.0, -40.0}, std::numbers::pi / 2.0, 8.0, 8.0, 4.5, 1.8);
  EXPECT_EQ(PostEncroachmentTime(stays, crosses, kRate).reason, "the first vehicle is in the common area at the end");
}

// Squares of 2 m: they touch side by side at 2 m; turned by 45 degrees the corner reaches sqrt 2.
TEST(Encroachment, RectanglesOverlap) {
  const Footprint square{{0.0, 0.0}, 0.0, 2.0, 2.0};
  EXPECT_TRUE(Overlap(square, {{1.99, 0.0}, 0.0, 2.0, 2.0}));
  EXPECT_FALSE(Overlap(square, {{2.01, 0.0}, 0.0, 2.0, 2.0}));
  const double reach = 1.0 + std::numbers::sqrt2;
  EXPECT_TRUE(Overlap(square, {{reach - 0.01, 0.0}, std::numbers::pi / 4.0, 2.0, 2.0}));
  EXPECT_FALSE(Overlap(square, {{reach + 0.01, 0.0}, std::numbers::pi / 4.0, 2.0, 2.0}));
}

}  // namespace
}  // namespace rodeira::measures

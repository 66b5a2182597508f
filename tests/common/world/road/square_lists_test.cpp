// SPDX-License-Identifier: Apache-2.0
// Lists of what may reach a point: nothing that does is left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/world/road/square_lists.hpp"
#include "common/world/road/squares.hpp"

namespace rodeira::road {
namespace {

double Drawn(std::uint64_t i, std::uint64_t what, double low, double high) {
  return base::RandomUniform({i, what, 53}, low, high);
}

// Strips of 0.1 to 150 m width and up to 400 m length, some of them a single place, far from the origin.
std::vector<SquareLists::Strip> Strips() {
  std::vector<SquareLists::Strip> strips;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Eigen::Vector2d from_W(4'000'000.0 + Drawn(i, 0, -1500.0, 1500.0), Drawn(i, 1, -900.0, 900.0));
    const double heading = Drawn(i, 2, -3.2, 3.2), length_m = i % 7 == 0 ? 0.0 : Drawn(i, 3, 0.0, 400.0);
    strips.push_back({from_W, from_W + length_m * Eigen::Vector2d(std::cos(heading), std::sin(heading)),
                      std::pow(10.0, Drawn(i, 4, -1.0, 2.18))});
  }
  return strips;
}

// How far a place is from a strip's way, by the nearest of many places of it.
double Sampled(const SquareLists::Strip& strip, const Eigen::Vector2d& p_W) {
  double nearest_m = 1e9;
  for (int k = 0; k <= 4000; ++k)
    nearest_m = std::min(nearest_m, (strip.from_W + k / 4000.0 * (strip.to_W - strip.from_W) - p_W).norm());
  return nearest_m;
}

TEST(SquareLists, HoldEveryStripThatHoldsThePoint) {
  const std::vector<SquareLists::Strip> strips = Strips();
  const SquareLists lists{strips};
  std::size_t held = 0, listed = 0;
  for (std::uint64_t n = 0; n < 20'000; ++n) {
    Eigen::Vector2d p_W(4'000'000.0 + Drawn(n, 5, -2200.0, 2200.0), Drawn(n, 6, -1600.0, 1600.0));
    if (n % 2 == 0) {  // at the very edge of one of them
      const SquareLists::Strip& strip = strips[n / 2 % strips.size()];
      const double angle = Drawn(n, 7, -3.2, 3.2);
      p_W = strip.to_W + (1.0 - 1e-9) * strip.reach_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    const auto at = lists.At(p_W);
    EXPECT_TRUE(std::is_sorted(at.begin(), at.end()) && std::adjacent_find(at.begin(), at.end()) == at.end());
    listed += at.size();
    for (std::uint32_t i = 0; i < strips.size(); ++i) {
      if (strips[i].FromWay(p_W) > strips[i].reach_m) continue;
      ++held;
      EXPECT_TRUE(std::binary_search(at.begin(), at.end(), i)) << p_W.transpose() << ", strip " << i;
    }
  }
  EXPECT_GT(held, 10'000u);
  EXPECT_LT(listed, 5 * held);  // what is far away is left out
}

TEST(SquareLists, AWaysDistanceIsThatOfItsNearestPlace) {
  const std::vector<SquareLists::Strip> strips = Strips();
  for (std::uint64_t n = 0; n < 400; ++n) {
    const SquareLists::Strip& strip = strips[n % strips.size()];
    const Eigen::Vector2d p_W = strip.from_W + Eigen::Vector2d(Drawn(n, 8, -500.0, 500.0), Drawn(n, 9, -500.0, 500.0));
    const double sampled_m = Sampled(strip, p_W);
    EXPECT_LE(strip.FromWay(p_W), sampled_m + 1e-6);
    EXPECT_GE(strip.FromWay(p_W), sampled_m - 0.06);  // half a step
  }
}

TEST(SquareLists, OfNothingAreEmptyEverywhere) {
  EXPECT_TRUE(SquareLists().At({0.0, 0.0}).empty());
  EXPECT_TRUE(SquareLists(std::span<const SquareLists::Strip>()).At({3.0, -4.0}).empty());
  const SquareLists::Strip one{{10.0, 10.0}, {20.0, 10.0}, 5.0};
  const SquareLists lists({&one, 1});
  EXPECT_EQ(lists.At({15.0, 12.0}).size(), 1u);
  EXPECT_TRUE(lists.At({500.0, 10.0}).empty());
  EXPECT_TRUE(lists.At({-500.0, 10.0}).empty());
  EXPECT_TRUE(lists.At({std::nan(""), 10.0}).empty());
}

// Boxes of 0.1 to 300 m, some of them a single place, far from the origin: they are touched to their very corners, and
// most of the rest is not.
TEST(Squares, AreTouchedWhereverABoxIs) {
  std::vector<Squares::Box> boxes;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const Eigen::Vector2d low_W(4'000'000.0 + Drawn(i, 10, -3000.0, 3000.0), Drawn(i, 11, -2000.0, 2000.0));
    const Eigen::Vector2d size =
        i % 7 == 0 ? Eigen::Vector2d::Zero() : Eigen::Vector2d(Drawn(i, 12, 0.1, 300.0), Drawn(i, 13, 0.1, 300.0));
    boxes.push_back({low_W, low_W + size});
  }
  const Squares squares{boxes};
  for (std::uint64_t n = 0; n < 20'000; ++n) {
    const Squares::Box& box = boxes[n % boxes.size()];
    const bool corner = n % 3 == 0;
    const Eigen::Vector2d part(corner ? static_cast<double>(n / 3 % 2) : Drawn(n, 14, 0.0, 1.0),
                               corner ? static_cast<double>(n / 6 % 2) : Drawn(n, 15, 0.0, 1.0));
    const Eigen::Vector2d p_W = box.low_W + part.cwiseProduct(box.high_W - box.low_W);
    EXPECT_TRUE(squares.MayHold(p_W)) << p_W.transpose();
  }
  int held = 0;
  for (std::uint64_t n = 0; n < 10'000; ++n)
    held += squares.MayHold({4'000'000.0 + Drawn(n, 16, -3000.0, 3000.0), Drawn(n, 17, -2000.0, 2000.0)}) ? 1 : 0;
  EXPECT_LT(held, 2500);
  EXPECT_GT(held, 100);
  EXPECT_FALSE(squares.MayHold({3'000'000.0, 0.0}));
  EXPECT_FALSE(squares.MayHold({4'000'000.0, std::nan("")}));
  EXPECT_FALSE(Squares().MayHold({0.0, 0.0}));
}

}  // namespace
}  // namespace rodeira::road

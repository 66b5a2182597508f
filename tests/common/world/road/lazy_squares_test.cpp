// SPDX-License-Identifier: Apache-2.0
// What is made of a square when it is first asked for: the same for every caller, and for every point of the square.
#include "common/world/road/lazy_squares.hpp"

#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "common/core/base/random.hpp"

namespace rodeira::road {
namespace {

using Eigen::Vector2d;

struct Made {
  Vector2d middle_W;
  std::size_t square;
};

Made Make(std::size_t square, const Vector2d& middle_W) { return {middle_W, square}; }

TEST(LazySquares, APointIsWithinItsSquare) {
  const SquareGrid grid(Vector2d(-300.0, 1000.0), Vector2d(500.0, 1700.0), 70.0);
  const LazySquares<Made> squares(grid, 8.0);
  EXPECT_EQ(squares.At({-310.0, 1200.0}, Make), nullptr);
  std::set<const Made*> all;
  double farthest_m = 0.0;
  for (std::uint64_t i = 0; i < 50'000; ++i) {
    const Vector2d p_W(base::RandomUniform({i, 1}, -300.0, 500.0), base::RandomUniform({i, 2}, 1000.0, 1700.0));
    const Made* made = squares.At(p_W, Make);
    ASSERT_NE(made, nullptr);
    EXPECT_EQ(made->square, *grid.At(p_W));
    farthest_m = std::max(farthest_m, (p_W - made->middle_W).norm());
    all.insert(made);
  }
  EXPECT_LE(farthest_m, squares.radius_m());
  EXPECT_GT(farthest_m, 0.95 * squares.radius_m());
  EXPECT_NEAR(static_cast<double>(all.size()), 800.0 * 700.0 / 64.0, 800.0);
}

// A file may say that its roads reach across the solar system.
TEST(LazySquares, OfASquareThatIsFarTooLargeThereAreFew) {
  const SquareGrid grid(Vector2d(-1e15, -1e15), Vector2d(1e15, 1e15), 70.0);
  const LazySquares<Made> squares(grid, 8.0);
  std::set<const Made*> all;
  for (double x = -9.9e14; x < 1e15; x += 1e11) all.insert(squares.At({x, 0.0}, Make));
  EXPECT_EQ(all.count(nullptr), 0u);
  EXPECT_LE(squares.radius_m(), grid.side_m());
}

TEST(LazySquares, ThreadsThatComeTogetherGetTheSame) {
  const SquareGrid grid(Vector2d(0.0, 0.0), Vector2d(400.0, 400.0), 70.0);
  const LazySquares<Made> squares(grid, 8.0);
  std::vector<std::vector<const Made*>> got(4);
  std::vector<std::thread> threads;
  for (auto& of : got) {
    threads.emplace_back([&] {
      for (double x = 1.0; x < 400.0; x += 5.0) {
        for (double y = 1.0; y < 400.0; y += 5.0) of.push_back(squares.At({x, y}, Make));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  ASSERT_EQ(got.front().size(), 6400u);
  for (const auto& of : got) EXPECT_EQ(of, got.front());
}

}  // namespace
}  // namespace rodeira::road

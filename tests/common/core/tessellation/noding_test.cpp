// SPDX-License-Identifier: Apache-2.0
#include "common/core/tessellation/noding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "common/core/base/random.hpp"

namespace rodeira::tessellation {
namespace {

TEST(Noding, ACrossingIsAPointOfBoth) {
  const std::vector<GridLine> lines = {{{0, 0}, {10, 10}}, {{0, 10}, {10, 0}}};
  const std::vector<GridSegment> expected = {
      {{0, 0}, {5, 5}}, {{0, 10}, {5, 5}}, {{5, 5}, {10, 0}}, {{5, 5}, {10, 10}}};
  EXPECT_EQ(Node(lines), expected);
}

TEST(Noding, WhatLiesTwiceComesOnce) {
  const std::vector<GridLine> lines = {{{0, 0}, {10, 0}}, {{20, 0}, {4, 0}}, {{7, 7}, {7, 7}}};
  const std::vector<GridSegment> expected = {{{0, 0}, {4, 0}}, {{4, 0}, {10, 0}}, {{10, 0}, {20, 0}}};
  EXPECT_EQ(Node(lines), expected);
  EXPECT_TRUE(Node({}).empty());
}

// The same lines cut into single segments, in another order and some the other way round.
TEST(Noding, HowLinesAreCutChangesNothing) {
  for (std::uint64_t seed = 30; seed < 36; ++seed) {
    const double most = seed % 2 == 0 ? 60.0 : 2.0e6;
    std::vector<GridLine> lines, pieces;
    for (std::uint64_t n = 0; n < 40; ++n) {
      GridLine line = n % 4 == 0 && n > 0 ? GridLine{lines.back().back()} : GridLine{};  // some begin where others end
      while (line.size() < 5)
        line.push_back({static_cast<std::int32_t>(base::RandomUniform({seed, n, line.size(), 0}, 0.0, most)),
                        static_cast<std::int32_t>(base::RandomUniform({seed, n, line.size(), 1}, 0.0, most))});
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        pieces.push_back(i % 2 == 0 ? GridLine{line[i], line[i + 1]} : GridLine{line[i + 1], line[i]});
      lines.push_back(line);
    }
    std::sort(pieces.begin(), pieces.end());
    EXPECT_EQ(Node(lines), Node(pieces)) << "seed " << seed;
  }
}

// By the definition: no two segments share more than an end.
TEST(Noding, NothingCrossesAfterwards) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    std::vector<GridLine> lines;
    const double most = seed % 2 == 0 ? 100.0 : 2.0e6;
    for (std::uint64_t n = 0; n < 60; ++n) {
      const auto draw = [&](std::uint64_t what) {
        return static_cast<std::int32_t>(base::RandomUniform({seed, n, what}, 0.0, most));
      };
      lines.push_back({{draw(0), draw(1)}, {draw(2), draw(3)}, {draw(4), draw(5)}});
    }
    const auto segments = Node(lines);
    ASSERT_GE(segments.size(), 60U);
    const auto side = [](std::int64_t turn) { return (turn > 0) - (turn < 0); };
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (std::size_t j = i + 1; j < segments.size(); ++j) {
        const auto& [a, b] = segments[i];
        const auto& [c, d] = segments[j];
        const int c_side = side(Turn(a, b, c)), d_side = side(Turn(a, b, d)), a_side = side(Turn(c, d, a)),
                  b_side = side(Turn(c, d, b));
        EXPECT_FALSE(c_side * d_side < 0 && a_side * b_side < 0) << "seed " << seed << ": they cross";
        for (const auto& [p, turn, from, to] : {std::tuple(c, c_side, a, b), std::tuple(d, d_side, a, b),
                                                std::tuple(a, a_side, c, d), std::tuple(b, b_side, c, d)}) {
          const bool between = std::min(from.x, to.x) <= p.x && p.x <= std::max(from.x, to.x) &&
                               std::min(from.y, to.y) <= p.y && p.y <= std::max(from.y, to.y);
          EXPECT_FALSE(turn == 0 && between && p != from && p != to)
              << "seed " << seed << ": an end lies on another segment";
        }
      }
    }
  }
}

}  // namespace
}  // namespace rodeira::tessellation

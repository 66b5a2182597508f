// SPDX-License-Identifier: Apache-2.0
// Where a search begins changes no bit of what it finds. The oracles are the same searches without a hint.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/driving/driver/leader.hpp"
#include "common/driving/driver/way_from_start.hpp"
#include "tests/n222.hpp"

namespace rodeira::driver {
namespace {

const Way& Route() {
  static const auto found = WayFromStart(*N222(), std::nullopt, "test");
  return *found.value().way;
}

// Beside the route, or anywhere about it.
Eigen::Vector3d DrawnPoint(std::uint32_t i) {
  const double d = base::RandomUniform({21, i, 0}, 0.0, Route().length_m());
  const double reach = i % 3 == 0 ? 400.0 : 6.0;
  return Route().Position(d, 0.0) + Eigen::Vector3d(base::RandomUniform({21, i, 1}, -reach, reach),
                                                    base::RandomUniform({21, i, 2}, -reach, reach),
                                                    base::RandomUniform({21, i, 3}, -1.0, 1.0));
}

TEST(RouteHint, AnyHintFindsThePlaceThatASearchWithoutOneFinds) {
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p_W = DrawnPoint(i);
    const std::optional<double> z_m = i % 2 == 0 ? std::optional(p_W.z()) : std::nullopt;
    const auto expected = Route().Locate(p_W.x(), p_W.y(), z_m);
    auto hint = static_cast<std::size_t>(base::RandomUniform({21, i, 4}, 0.0, 20'000.0));  // beyond the last node, too
    for (int turn = 0; turn < 2; ++turn) {  // the second time from the node found
      const auto place = Route().Near(hint, p_W.x(), p_W.y(), z_m, {});
      ASSERT_EQ(place.has_value(), expected.has_value()) << i;
      if (!place) continue;
      ++found;
      EXPECT_EQ(place->d_m, expected->d_m) << i;
      EXPECT_EQ(place->offset_m, expected->offset_m) << i;
      EXPECT_EQ(place->heading_rad, expected->heading_rad) << i;
    }
    if (!expected) continue;
    const LaneFrame frame = Route().At(expected->d_m);
    EXPECT_EQ(expected->heading_rad, frame.heading_rad) << i;
    EXPECT_EQ(Route().HeadingAt(expected->d_m), frame.heading_rad) << i;
    EXPECT_EQ(Route().MiddleAt(expected->d_m), frame.p_W) << i;
  }
  EXPECT_GT(found, 1000u);
}

TEST(RouteHint, ARangeLosesNoPlaceWithinIt) {
  std::size_t left_out = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p_W = DrawnPoint(i);
    const auto expected = Route().Locate(p_W.x(), p_W.y());
    if (!expected) continue;
    std::size_t hint = 0;
    const double from = base::RandomUniform({22, i}, 0.0, Route().length_m()), to = from + 500.0;
    const auto place = Route().Near(hint, p_W.x(), p_W.y(), std::nullopt, {from, to});
    if (place) {
      EXPECT_EQ(place->d_m, expected->d_m) << i;
    }
    if (expected->d_m >= from && expected->d_m <= to) {
      EXPECT_TRUE(place.has_value()) << i;
    }
    left_out += !place;
    EXPECT_TRUE(Route().Near(hint, p_W.x(), p_W.y(), std::nullopt, {expected->d_m, expected->d_m}).has_value()) << i;
  }
  EXPECT_GT(left_out, 500u);
}

// Every car is placed, and the nearest in the way is kept.
std::optional<Leader> LeaderOfAll(const std::vector<Footprint>& others, double middle_m, double front_m,
                                  double half_width_m, double range_m) {
  std::optional<Leader> nearest;
  const Eigen::Vector3d here = Route().At(middle_m).p_W;
  for (const Footprint& other : others) {
    if (std::hypot(other.x_m - here.x(), other.y_m - here.y()) > range_m + front_m - middle_m + other.length_m)
      continue;
    const auto span = Route().SpanOf(other);
    if (!span || 0.5 * (span->rear_m + span->front_m) <= middle_m) continue;
    if (span->right_m > half_width_m || span->left_m < -half_width_m) continue;
    const double gap = span->rear_m - front_m;
    if (gap <= range_m && (!nearest || gap < nearest->gap_m)) nearest = Leader{gap, span->speed_mps};
  }
  return nearest;
}

TEST(RouteHint, TheLeaderIsThatOfASearchThatPlacesEveryCar) {
  LeaderHints hints;  // kept over all steps, as the autopilot does
  std::size_t found = 0;
  for (std::uint32_t step = 0; step < 500; ++step) {
    const double middle = base::RandomUniform({23, step}, 50.0, Route().length_m() - 200.0), front = middle + 2.0;
    std::vector<Footprint> others;
    const auto count = static_cast<std::uint32_t>(base::RandomUniform({23, step, 1}, 0.0, 12.0));
    for (std::uint32_t i = 0; i < count; ++i) {
      const double d = middle + base::RandomUniform({23, step, i, 2}, -60.0, 180.0);
      const Eigen::Vector3d p_W = Route().Position(std::max(0.0, d), base::RandomUniform({23, step, i, 3}, -5.0, 5.0));
      others.push_back({i, p_W.x(), p_W.y(), base::RandomUniform({23, step, i, 4}, -3.0, 3.0), 10.0,
                        base::RandomUniform({23, step, i, 5}, 0.5, 12.0), 1.8});
    }
    if (count > 3) others[2] = others[0];  // of equal ones the first
    const auto leader = FindLeader(Route(), others, middle, front, 1.3, 150.0, hints);
    const auto expected = LeaderOfAll(others, middle, front, 1.3, 150.0);
    ASSERT_EQ(leader.has_value(), expected.has_value()) << step;
    if (!leader) continue;
    ++found;
    EXPECT_EQ(leader->gap_m, expected->gap_m) << step;
    EXPECT_EQ(leader->speed_mps, expected->speed_mps) << step;
  }
  EXPECT_GT(found, 100u);
}

}  // namespace
}  // namespace rodeira::driver

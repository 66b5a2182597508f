// SPDX-License-Identifier: Apache-2.0
// Promises of callers: a node of a curve is one of its own, a lane beside another one lies beside it.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "common/world/lanes/graph.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::lanes {
namespace {

TEST(ContractsDeathTest, AFootIsLookedForAtANodeOfTheCurve) {
  const auto network = MapNetwork("roundabout");
  const Graph graph(*network);
  ASSERT_FALSE(graph.tracks().empty());
  const Curve& curve = graph.tracks().front().curve;
  const std::size_t count = curve.nodes().size();
  EXPECT_NEAR(curve.FootNear(curve.nodes().back().p_W.head<2>(), count - 1).d_m, curve.length_m(), 1e-9);
  EXPECT_DEATH((void)curve.FootNear({0.0, 0.0}, count), "node < nodes_.size\\(\\)");
}

// Of two roads that are far from each other, neither lane lies beside the other one.
TEST(ContractsDeathTest, APlaceIsFoundOnALaneBesideTheOwnOne) {
  const auto network = MapNetwork("town");
  const Graph graph(*network);
  const auto distance_m = [&](std::uint32_t track) {
    return (graph[track].curve.At(0.0).p_W - graph[0].curve.At(0.0).p_W).norm();
  };
  std::uint32_t other = 0;
  for (std::uint32_t track = 1; track < graph.tracks().size(); ++track) {
    if (distance_m(track) > distance_m(other)) other = track;
  }
  ASSERT_GT(distance_m(other), 100.0);
  ASSERT_NE(graph[other].lane.road, graph[0].lane.road);
  EXPECT_DEATH((void)graph.Across(0, 1.0, other), "found != feet_.end\\(\\)");
}

}  // namespace
}  // namespace rodeira::lanes

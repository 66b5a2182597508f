// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_furniture/trees.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/view/scene/worlds.hpp"

namespace rodeira::scene {
namespace {

TEST(Trees, StandOnTheGroundBesideTheRoad) {
  const auto world = N222OfVersion1();
  const road::Road& road = world->roads()[0];
  const std::vector<Tree> trees = PlantTrees(*world, 1);
  EXPECT_GT(trees.size(), 2'000U);
  EXPECT_LT(trees.size(), 40'000U);
  for (const Tree& tree : trees) {
    EXPECT_EQ(tree.foot_W.z(), world->At(tree.foot_W.x(), tree.foot_W.y()).z_m);
    const auto at = road.Locate(tree.foot_W.x(), tree.foot_W.y());
    if (!at) continue;
    const double beside = std::max(at->t_m - road.section().paved_left_m(), road.section().paved_right_m() - at->t_m);
    EXPECT_GT(beside, tree.crown_m + 3.0) << "over the road at s = " << at->s_m;
  }
}

TEST(Trees, ComeFromTheSeedAlone) {
  const auto world = N222OfVersion1();
  const std::vector<Tree> one = PlantTrees(*world, 1), again = PlantTrees(*world, 1), other = PlantTrees(*world, 2);
  ASSERT_EQ(one.size(), again.size());
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i].foot_W, again[i].foot_W);
  EXPECT_NE(one.front().foot_W, other.front().foot_W);
}

TEST(Trees, NoneOnAPlane) { EXPECT_TRUE(PlantTrees(*PlaneWithRoad(), 1).empty()); }

}  // namespace
}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
// Models at many places: where their triangles are when they are merged, and what of a tile is repeated at all.
#include "common/view/scene/mesh/repeated.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "common/view/scene/road_furniture/static_objects.hpp"
#include "common/view/scene/road_furniture/trees.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

TEST(Repeated, AModelIsTurnedAndGrownAtItsPlace) {
  Repeated repeated;
  repeated.model.material = Material::kMatt;
  repeated.model.Add({1.0, 2.0, 3.0}, Vector3d(0.6, 0.0, 0.8), Colour::Of(0x102030));
  repeated.model.Add({0.0, 0.0, 1.0}, Vector3d::UnitX(), Colour::Of(0x405060));
  repeated.model.Add({0.0, 0.0, 0.0}, Vector3d::UnitZ(), Colour::Of(0x708090));
  repeated.model.AddTriangle(0, 1, 2);
  repeated.origin_W = {128.0, 64.0, 0.0};
  repeated.places = {{{{130.0, 60.0, 7.0}, {0.0, 1.0}}, 2.0, 10.0, {}},
                     {{{100.0, 60.0, 8.0}, {1.0, 0.0}}, 1.0, 1.0, {}}};  // a quarter turn to the left
  const std::vector<Mesh> merged = Merged({&repeated, 1});
  ASSERT_EQ(merged.size(), 1U);
  ASSERT_EQ(merged[0].triangle_count(), 2U);
  EXPECT_EQ(merged[0].PositionW(0), Vector3d(130.0 - 4.0, 60.0 + 2.0, 7.0 + 30.0));
  EXPECT_NEAR((merged[0].normals[0] - Eigen::Vector3f(0.0F, 0.6F, 0.8F)).norm(), 0.0F, 1e-7F);
  EXPECT_EQ(merged[0].colours[0], Colour::Of(0x102030));
  EXPECT_EQ(merged[0].PositionW(merged[0].triangles[3]), Vector3d(101.0, 62.0, 11.0));
}

TEST(Repeated, LeavesHaveTheirTreesColourAndTrunksTheirOwn) {
  Tree tree;
  tree.leaves = Colour::Of(0x50a030);
  tree.height_m = 6.0;
  tree.crown_m = 2.0;
  Repeated repeated = TreeModel(TreeKind::kRound, 0);
  repeated.places = {PlaceOf(tree)};
  const Mesh mesh = Merged({&repeated, 1}).front();
  double highest = 0.0, widest = 0.0;
  bool bark = false, dark = false, light = false;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    highest = std::max(highest, mesh.PositionW(i).z());
    widest = std::max(widest, mesh.PositionW(i).head<2>().norm());
    bark |= mesh.colours[i] == Colour::Of(0x5b4936);
    dark |= mesh.colours[i] == Shade(tree.leaves, 0.72);
    light |= mesh.colours[i] == Shade(tree.leaves, 1.12);
  }
  EXPECT_NEAR(highest, 6.0, 1e-6);
  EXPECT_NEAR(widest, 2.0, 1e-6);
  EXPECT_TRUE(bark && dark && light);
  for (const TreeKind kind : {TreeKind::kRound, TreeKind::kCone, TreeKind::kBush}) {
    for (int level = 0; level < 3; ++level) {
      for (const float share : TreeModel(kind, level).light)
        EXPECT_TRUE(share < 0.0F || 4.0F * share == std::floor(4.0F * share)) << "a graphics card gets quarters";
    }
  }
}

TEST(Repeated, OnlyWhatStandsOftenIsRepeated) {
  const auto world = OpenDriveWorld(
      R"(<road id="1" length="200" junction="-1"><planView><geometry s="0" x="20" y="100" hdg="0" length="200"><line/>
          </geometry></planView>
    <lanes><laneSection s="0"><center><lane id="0"/></center><right><lane id="-1" type="driving">
      <width sOffset="0" a="4" b="0" c="0" d="0"/></lane></right></laneSection></lanes>
    <objects><object id="t" type="tree" s="0" t="-12" zOffset="0" radius="3" height="7">
      <repeat s="0" length="190" distance="10" tStart="-12" tEnd="-12"/></object>
    <object id="p" type="guide-post" s="0" t="-6" zOffset="0" height="1">
      <repeat s="0" length="180" distance="20" tStart="-6" tEnd="-6"/></object>
    <object id="l" type="streetLamp" s="0" t="6" zOffset="0" height="8">
      <repeat s="0" length="150" distance="50" tStart="6" tEnd="6"/></object></objects></road>)");
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  ASSERT_EQ(things.tiles().size(), 1U);
  const auto& [key, tile] = *things.tiles().begin();
  const auto places_of = [&](int level) {
    std::multiset<std::size_t> places;
    for (const Repeated& repeated : DrawStaticObjects(tile, key, level).repeated) places.insert(repeated.places.size());
    return places;
  };
  EXPECT_EQ(places_of(0), (std::multiset<std::size_t>{10, 20}));  // the four lamps are merged
  EXPECT_EQ(places_of(1), (std::multiset<std::size_t>{10, 20}));
  EXPECT_EQ(places_of(2), (std::multiset<std::size_t>{20})) << "posts are not seen from so far";
  EXPECT_EQ(places_of(3), (std::multiset<std::size_t>{}));
  const DrawnStaticObjects drawn = DrawStaticObjects(tile, key, 0);
  ASSERT_EQ(drawn.meshes.size(), 1U);
  ASSERT_FALSE(drawn.meshes[0].positions.empty());
  for (std::size_t i = 0; i < drawn.meshes[0].positions.size(); ++i)
    EXPECT_GT(drawn.meshes[0].PositionW(i).y(), 100.0) << "the lamps alone";
}

}  // namespace
}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the scene: meshes of one origin, rings of one size, moments in order, a world with roads.
#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "common/view/scene/mesh/loft.hpp"
#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/mesh/repeated.hpp"
#include "common/view/scene/playback/player.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

TEST(ContractsDeathTest, MeshesThatAreJoinedHaveOneOrigin) {
  Mesh here, there;
  there.origin_W = {64.0, 0.0, 0.0};
  here.Append(Mesh());
  EXPECT_DEATH(here.Append(there), "origin_W == other.origin_W");
  std::array<Repeated, 2> all;
  EXPECT_EQ(Merged(all).size(), 1U);
  all[1].origin_W = there.origin_W;
  EXPECT_DEATH((void)Merged(all), "repeated.origin_W == all.front\\(\\).origin_W");
}

TEST(ContractsDeathTest, NormalsAreSmoothedOfTrianglesWithVerticesOfTheirOwn) {
  Mesh mesh;
  for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)})
    mesh.Add(p, Vector3d::UnitZ(), Colour());
  mesh.AddTriangle(0, 1, 2);
  SmoothNormals(mesh, 0.5);
  mesh.AddTriangle(0, 1, 2);
  EXPECT_DEATH(SmoothNormals(mesh, 0.5), "mesh.positions.size\\(\\) == mesh.triangles.size\\(\\)");
}

TEST(ContractsDeathTest, ALoftHasTwoRingsOfOneSize) {
  const std::vector<Vector3d> three{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, two{{1, 0, 0}, {1, 1, 0}};
  EXPECT_DEATH((void)Loft({three}, Material::kMatt, Colour(), 0.5), "rings.size\\(\\) >= 2");
  EXPECT_DEATH((void)Loft({three, two}, Material::kMatt, Colour(), 0.5), "rings\\[r \\+ 1\\].size\\(\\) == count");
}

TEST(ContractsDeathTest, APlayerHasALengthAndAPicturesTime) {
  EXPECT_EQ(Player(0, 1).speed(), 1.0);
  EXPECT_DEATH(Player(-1, 1), "end_ns >= 0");
  EXPECT_DEATH(Player(1, 0), "picture_ns > 0");
}

TEST(ContractsDeathTest, MomentsComeInOrderAndAnAlphaIsAShare) {
  PoseHistory history;
  EXPECT_DEATH((void)history.At(0.0), "!moments_.empty\\(\\)");
  SceneSnapshot first, second;
  first.time_ns = 1'000, second.time_ns = 2'000;
  history.Add(second);
  EXPECT_DEATH(history.Add(first), "moments_.back\\(\\).time_ns < moment.time_ns");
  EXPECT_EQ(history.At(5e3).time_ns, 2'000);
  EXPECT_EQ(Interpolate(first, second, 0.5).time_ns, 1'500);
  for (const double alpha : {-0.01, 1.01})
    EXPECT_DEATH((void)Interpolate(first, second, alpha), "alpha >= 0.0 && alpha <= 1.0");
}

TEST(ContractsDeathTest, WhatStandsAtRoadsIsOfAWorldWithRoads) {
  const auto bare = road::World::Parse("rodeira: world/2\nname: w\nground: {kind: plane}\n", "bare.yaml");
  ASSERT_TRUE(bare.ok()) << bare.error().Text();
  ASSERT_EQ(bare.value()->network(), nullptr);
  EXPECT_DEATH(StaticObjects(*bare.value()), "world.network\\(\\) != nullptr");
}

}  // namespace
}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
// Promises of callers that turn meshes into geometries: one origin, places for each vertex, a world with roads.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <span>

#include "common/world/road/world.hpp"
#include "nodes/view/frame/quality.hpp"
#include "nodes/view/materials/face_texture.hpp"
#include "nodes/view/materials/material_library.hpp"
#include "nodes/view/materials/plain_geometry.hpp"
#include "nodes/view/paging/made_world.hpp"

namespace rodeira::nodes {
namespace {

TEST(ContractsDeathTest, WhatIsPlacedTogetherHasOneOrigin) {
  MaterialLibrary library(TraitsOf(Quality::kLow), true);
  const scene::Mesh here;
  scene::Mesh there;
  there.origin_W = {64.0, 0.0, 0.0};
  const std::array<const scene::Mesh*, 2> meshes{&here, &there};
  EXPECT_DEATH((void)library.Placed(std::span<const scene::Mesh* const>()), "!meshes.empty\\(\\)");
  EXPECT_DEATH((void)library.Placed(meshes), "mesh->origin_W == origin");
  EXPECT_NE(library.Placed(std::span(meshes).first(1)), nullptr);
  std::array<scene::Repeated, 2> repeated;
  repeated[1].origin_W = there.origin_W;
  EXPECT_DEATH((void)library.Placed(std::span<const scene::Repeated>()), "!all.empty\\(\\)");
  EXPECT_DEATH((void)library.Placed(repeated), "repeated.origin_W == all.front\\(\\).origin_W");
}

TEST(ContractsDeathTest, EachVertexOfAFaceHasAPlaceOnIt) {
  scene::Mesh mesh;
  mesh.Add({0.0, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), scene::Colour());
  EXPECT_DEATH((void)PlacesOnFace(mesh), "mesh.on_face.size\\(\\) == mesh.positions.size\\(\\)");
  mesh.on_face.push_back({0.5F, 0.5F});
  EXPECT_EQ(PlacesOnFace(mesh)->size(), 1U);
}

TEST(ContractsDeathTest, OnlyARepeatedGeometryIsSpread) {
  const osg::ref_ptr<osg::Geometry> plain = PlainGeometry(scene::Mesh());
  EXPECT_DEATH(Spread(*plain), "places != nullptr");
  Spread(*RepeatedGeometry(scene::Repeated()));
}

TEST(ContractsDeathTest, AVisualWorldIsOfAWorldWithRoads) {
  const auto bare = road::World::Parse("rodeira: world/2\nname: w\nground: {kind: plane}\n", "bare.yaml");
  ASSERT_TRUE(bare.ok()) << bare.error().Text();
  MaterialLibrary library(TraitsOf(Quality::kLow), true);
  EXPECT_DEATH((void)BuildVisualWorld(*bare.value(), library, {}, nullptr), "world.network\\(\\) != nullptr");
}

}  // namespace
}  // namespace rodeira::nodes

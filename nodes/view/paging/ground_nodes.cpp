// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/paging/ground_nodes.hpp"

#include <osg/LOD>

#include "nodes/view/materials/model_file.hpp"
#include "nodes/view/materials/to_osg.hpp"

namespace rodeira::nodes {

PlacedNode TerrainNode(MaterialLibrary& look, const scene::TerrainTile& tile) {
  osg::ref_ptr<osg::LOD> lod = new osg::LOD;
  lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
  lod->setCenter(ToOsg(tile.centre_W));
  lod->setRadius(tile.radius_m);
  float from = 0.0F;
  for (std::size_t level = 0; level < tile.levels.size(); ++level) {
    const scene::Mesh* mesh = &tile.levels[level];
    const float to = scene::TerrainSeen_m(tile, level);
    lod->addChild(look.Placed({&mesh, 1}), from, to);
    from = to;
  }
  return {tile.centre_W.head<2>(), lod};
}

osg::ref_ptr<osg::Group> LevelNode(MaterialLibrary& look, const scene::GroundLevel& level) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  std::vector<const scene::Mesh*> meshes, things;
  for (const scene::Mesh& mesh : level.ground) meshes.push_back(&mesh);
  if (!meshes.empty()) group->addChild(look.Placed(meshes));
  const scene::Mesh* marks = &level.marks;
  if (!marks->triangles.empty()) group->addChild(look.Placed({&marks, 1}));
  for (const scene::Mesh& mesh : level.things) things.push_back(&mesh);
  if (!things.empty()) group->addChild(look.Placed(things));
  if (!level.repeated.empty()) group->addChild(look.Placed(level.repeated));
  if (!level.models.empty()) {
    const osg::ref_ptr<osg::Group> models = PlaceModels(level.models);
    models->setNodeMask(kOnlyNear);
    group->addChild(models);
  }
  return group;
}

PlacedNode GroundNode(MaterialLibrary& look, const scene::GroundTile& tile) {
  osg::ref_ptr<osg::LOD> lod = new osg::LOD;
  lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
  lod->setCenter(ToOsg(tile.ball.centre_W));
  lod->setRadius(tile.ball.radius_m);
  float from = 0.0F;
  for (std::size_t level = 0; level < tile.levels.size(); ++level) {
    lod->addChild(LevelNode(look, tile.levels[level]), from, scene::kGroundSeen_m[level]);
    from = scene::kGroundSeen_m[level];
  }
  return {tile.ball.centre_W.head<2>(), lod};
}

}  // namespace rodeira::nodes

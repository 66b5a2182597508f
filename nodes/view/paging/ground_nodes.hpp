// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Group>
#include <osg/ref_ptr>

#include <vector>

#include "common/view/scene/mesh/repeated.hpp"
#include "common/view/scene/terrain/ribbon.hpp"
#include "common/view/scene/terrain/terrain_mesh.hpp"
#include "common/view/scene/visual_world/ground_tile.hpp"
#include "nodes/view/materials/look.hpp"
#include "nodes/view/paging/tile_tree.hpp"

namespace rodeira::nodes {

// What stands still, as the look draws it. Several threads may ask for levels once it has made its states
// (Look::MakeStates).

// A network's tile at one of its levels.
osg::ref_ptr<osg::Group> LevelNode(Look& look, const scene::GroundLevel& level);
// All of its levels, each shown at its distances.
PlacedNode GroundNode(Look& look, const scene::GroundTile& tile);
// Land of a world without roads, or beside roads of version 1.
PlacedNode TerrainNode(Look& look, const scene::TerrainTile& tile);
// Trees of a square, seen from so far as it is from the middle of their feet: however they are drawn.
PlacedNode TreesNode(Look& look, const std::vector<scene::Repeated>& trees);
// A piece of a road of version 1.
void AddRoadTile(Look& look, const scene::RoadTile& tile, osg::Group& group);

}  // namespace rodeira::nodes

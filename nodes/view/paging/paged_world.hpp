// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/FrameStamp>
#include <osg/Group>
#include <osg/PagedLOD>
#include <osg/ref_ptr>
#include <osgDB/DatabasePager>

#include <vector>

#include "nodes/view/paging/database_tiles.hpp"

namespace rodeira::nodes {

// Ground with tiles that come where the eye comes near, by the pager's threads: read from a built database, or made.
struct PagedWorld {
  osg::ref_ptr<osg::Group> root;      // null: there is none
  std::vector<osg::PagedLOD*> tiles;  // all below the root, however it groups them
};

// A PagedLOD a tile, below groups of neighbouring ones (TileTree), each with its files in the order in which they are
// asked for: the coarsest first.
PagedWorld PagedTree(const std::vector<TileFiles>& tiles);
// Gives back the levels of tiles that the eye has left by a quarter of their range, and tiles far beyond what is drawn
// at all. Only while the pager reads nothing. `detail_scale`: as the camera's.
void ReleaseFarTiles(const PagedWorld& paged, const osg::Vec3d& eye_W, double far_m, double detail_scale);
// How many levels of tiles are in memory.
std::size_t HeldLevels(const PagedWorld& paged);
// Asks for the coarsest level of the nearest few tiles that have none, wherever one looks: a viewer that turns round
// finds ground there. What a picture itself asks for comes first. `last`: of the picture before; to be asked again with
// each picture.
void RequestAhead(const PagedWorld& paged, osgDB::DatabasePager& pager, const osg::FrameStamp& last,
                  const osg::Vec3d& eye_W, double far_m);
// Whether the pager still reads, or makes, what it was asked for; what is there waits for the next picture.
bool IsReading(osgDB::DatabasePager& pager);

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/paging/paged_world.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "nodes/view/paging/tile_tree.hpp"

namespace rodeira::nodes {

PagedWorld PagedTree(const std::vector<TileFiles>& tiles) {
  PagedWorld paged;
  std::vector<PlacedNode> parts;
  for (const TileFiles& tile : tiles) {
    osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    lod->setCenter(osg::Vec3d(tile.ball.centre_W.x(), tile.ball.centre_W.y(), tile.ball.centre_W.z()));
    lod->setRadius(static_cast<float>(tile.ball.radius_m));
    // The coarsest first: files are read in this order, and what is there already is shown until the next one is.
    unsigned child = 0;
    for (auto level = tile.levels.rbegin(); level != tile.levels.rend(); ++level, ++child) {
      lod->setFileName(child, level->file);
      lod->setRange(child, level->from_m, level->to_m);
    }
    parts.push_back({tile.ball.centre_W.head<2>(), lod});
    paged.tiles.push_back(lod.get());
  }
  paged.root = TileTree(parts);
  return paged;
}

void ReleaseFarTiles(const PagedWorld& paged, const osg::Vec3d& eye_W, double far_m, double detail_scale) {
  // The coarsest level is wanted up to the plane at far_m, which is farther off in a wide picture's corners.
  constexpr double kBeyond = 1.25, kBeyondFar = 1.8;
  for (osg::PagedLOD* const at : paged.tiles) {
    osg::PagedLOD& tile = *at;
    const double distance_m = (tile.getCenter() - eye_W).length();
    while (tile.getNumChildren() > 0) {  // the finest is the last one, and has the shortest range
      const unsigned last = tile.getNumChildren() - 1;
      const double needed_m = last == 0 ? far_m + static_cast<double>(tile.getRadius())
                                        : static_cast<double>(tile.getMaxRange(last)) / detail_scale;
      osg::NodeList given;
      if (distance_m <= (last == 0 ? kBeyondFar : kBeyond) * needed_m ||
          !tile.removeExpiredChildren(std::numeric_limits<double>::max(), std::numeric_limits<unsigned>::max(), given))
        break;
    }
  }
}

std::size_t HeldLevels(const PagedWorld& paged) {
  std::size_t held = 0;
  for (const osg::PagedLOD* tile : paged.tiles) held += tile->getNumChildren();
  return held;
}

void RequestAhead(const PagedWorld& paged, osgDB::DatabasePager& pager, const osg::FrameStamp& last,
                  const osg::Vec3d& eye_W, double far_m) {
  constexpr std::size_t kAtOnce = 8;
  std::vector<std::pair<double, osg::PagedLOD*>> missing;
  for (osg::PagedLOD* tile : paged.tiles) {
    const double distance_m = (tile->getCenter() - eye_W).length();
    if (tile->getNumChildren() == 0 && distance_m <= far_m + static_cast<double>(tile->getRadius()))
      missing.emplace_back(distance_m, tile);
  }
  const std::size_t count = std::min(kAtOnce, missing.size());
  std::partial_sort(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(count), missing.end());
  for (std::size_t i = 0; i < count; ++i) {
    osg::PagedLOD& tile = *missing[i].second;
    osg::NodePath path{&tile};
    pager.requestNodeFile(tile.getDatabasePath() + tile.getFileName(0), path, 0.0F, &last, tile.getDatabaseRequest(0),
                          tile.getDatabaseOptions());
  }
}

bool IsReading(osgDB::DatabasePager& pager) {
  if (pager.getFileRequestListSize() > 0) return true;
  for (unsigned i = 0; i < pager.getNumDatabaseThreads(); ++i) {
    if (pager.getDatabaseThread(i)->getActive()) return true;
  }
  return false;
}

}  // namespace rodeira::nodes

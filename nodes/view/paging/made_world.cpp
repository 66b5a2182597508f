// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/paging/made_world.hpp"

#include <osgDB/Callbacks>
#include <osgDB/Options>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/assert.hpp"
#include "nodes/view/paging/cached_tiles.hpp"
#include "nodes/view/paging/database_tiles.hpp"
#include "nodes/view/paging/ground_nodes.hpp"

namespace rodeira::nodes {
namespace {

// Answers the pager, which asks for files by their names, with tiles. Its threads call it at once.
class MakeWhatIsAsked : public osgDB::ReadFileCallback {
 public:
  MakeWhatIsAsked(std::unique_ptr<const DatabaseTiles> tiles, const std::vector<TileFiles>& files,
                  MaterialLibrary& look)
      : tiles_(std::move(tiles)), look_(look) {
    for (std::size_t tile = 0; tile < files.size(); ++tile) {
      for (std::size_t level = 0; level < files[tile].levels.size(); ++level)
        places_[files[tile].levels[level].file] = {tile, level};
    }
  }

  osgDB::ReaderWriter::ReadResult readNode(const std::string& file, const osgDB::Options*) override {
    const auto found = places_.find(file);
    if (found == places_.end()) return osgDB::ReaderWriter::ReadResult::FILE_NOT_FOUND;
    const auto [tile, level] = found->second;
    const osg::ref_ptr<osg::Group> node = LevelNode(look_, tiles_->MakeLevel(tile, level));
    return node.get();
  }

 private:
  std::unique_ptr<const DatabaseTiles> tiles_;
  std::map<std::string, std::pair<std::size_t, std::size_t>> places_;
  MaterialLibrary& look_;
};

}  // namespace

PagedWorld BuildVisualWorld(const road::World& world, MaterialLibrary& look, scene::ModelIsThere is_there,
                            base::FileCache* cache) {
  RODEIRA_ASSERT(world.network() != nullptr);
  look.MakeStates();
  std::unique_ptr<const DatabaseTiles> tiles = CachedTilesOf(world, 0, std::move(is_there), cache);
  std::vector<TileFiles> files;
  for (std::size_t tile = 0; tile < tiles->count(); ++tile) files.push_back(tiles->FilesOf(tile));
  PagedWorld paged = PagedTree(files);
  const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
  options->setReadFileCallback(new MakeWhatIsAsked(std::move(tiles), files, look));
  for (osg::PagedLOD* tile : paged.tiles) tile->setDatabaseOptions(options);
  return paged;
}

}  // namespace rodeira::nodes

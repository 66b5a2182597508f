#pragma once

#include <osg/Group>
#include <osg/ref_ptr>

#include <filesystem>

#include "common/base/result.hpp"
#include "nodes/view/look.hpp"

namespace rodeira::view {

// The ground of a built database: its tiles are read where the eye comes near, by the pager's threads.
struct BuiltWorld {
  osg::ref_ptr<osg::Group> root;  // of PagedLODs
  unsigned tiles = 0;
};

// Reads `world.osgb` of a folder that FindBuilt found. Every tile gets this look as it is read, which must outlive the root. A failure
// where OpenSceneGraph cannot read the file.
base::Result<BuiltWorld> ReadBuilt(const std::filesystem::path& folder, Look& look);

}  // namespace rodeira::view

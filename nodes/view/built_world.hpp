#pragma once

#include <osg/Group>
#include <osg/PagedLOD>
#include <osg/ref_ptr>

#include <filesystem>
#include <vector>

#include "common/base/result.hpp"
#include "nodes/view/look.hpp"

namespace rodeira::view {

// The ground of a built database: its tiles are read where the eye comes near, by the pager's threads.
struct BuiltWorld {
  osg::ref_ptr<osg::Group> root;  // null: there is none
  std::vector<osg::PagedLOD*> tiles;  // all below the root, however it groups them
};

// Gives back the levels of tiles that the eye has left by a quarter of their range, and tiles beyond what is drawn at all. Only while the pager reads nothing.
// `detail_scale`: as the camera's.
void GiveBack(const BuiltWorld& built, const osg::Vec3d& eye_W, double far_m, double detail_scale);
// How many files of tiles are in memory.
std::size_t HeldLevels(const BuiltWorld& built);

// Reads `world.osgb` of a folder that FindBuilt found. Every tile gets this look as it is read, which must outlive the root. A failure
// where OpenSceneGraph cannot read the file.
base::Result<BuiltWorld> ReadBuilt(const std::filesystem::path& folder, Look& look);

}  // namespace rodeira::view

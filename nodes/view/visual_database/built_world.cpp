// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/visual_database/built_world.hpp"

#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osgDB/ReadFile>

#include <charconv>
#include <string_view>
#include <typeinfo>
#include <utility>
#include <vector>

#include "nodes/view/materials/picture_texture.hpp"
#include "nodes/view/materials/plain_geometry.hpp"
#include "nodes/view/visual_database/database.hpp"

namespace rodeira::nodes {
namespace {

// Gives geometries of the database the look of those that are built in memory.
class Dress : public osg::NodeVisitor {
 public:
  Dress(MaterialLibrary& look, std::filesystem::path folder)
      : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), look_(look), folder_(std::move(folder)) {
    setNodeMaskOverride(~0U);  // what is hidden from other programs too
  }

  void apply(osg::Geometry& geometry) override {
    const std::string_view name = geometry.getName(), begin = kGeometryName;
    if (!name.starts_with(begin)) return geometry.setNodeMask(geometry.getNodeMask() & kOnlyNear);  // of a model's file
    int number = -1;
    std::from_chars(name.data() + begin.size(), name.data() + name.size(), number);
    if (number < 0 || number >= scene::kMaterials) return;
    const auto material = static_cast<scene::Material>(number);
    const bool repeated = name.ends_with(kRepeatedName);
    if (repeated || name.ends_with(kMergedName)) {
      if (repeated != look_.repeats())
        return unwanted_.push_back(geometry.getParent(0));  // it has its place for itself
    }
    geometry.setNodeMask(ShadowMaskOf(material));
    if (material == scene::Material::kPicture) return LayPicture(geometry);
    if (material == scene::Material::kSign) {
      osg::StateSet* own = geometry.getStateSet();
      auto* face = own == nullptr
                       ? nullptr
                       : dynamic_cast<osg::Texture2D*>(own->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
      if (face == nullptr) return;
      geometry.setTexCoordArray(1, geometry.getTexCoordArray(0));
      geometry.setTexCoordArray(0, nullptr);
      geometry.setStateSet(look_.StateOfFace(*face));
    } else if (repeated) {
      Spread(geometry);
      geometry.setStateSet(look_.StateOfRepeated(material));
    } else {
      geometry.setStateSet(look_.StateOf(material));
    }
  }
  // Lets go of what this look draws in another way.
  void Clear() {
    for (const osg::ref_ptr<osg::Group>& place : unwanted_) {
      const osg::Node::ParentList parents = place->getParents();
      for (osg::Group* parent : parents) parent->removeChild(place);
    }
  }

 private:
  // The name goes on with the file, below the database's folder.
  void LayPicture(osg::Geometry& geometry) {
    const std::string& name = geometry.getName();
    const auto at = name.find(kPictureFolder);
    if (at == std::string::npos) return;
    geometry.setTexCoordArray(1, geometry.getTexCoordArray(0));
    geometry.setTexCoordArray(0, nullptr);
    geometry.setStateSet(
        look_.StateOfPicture((folder_ / name.substr(at)).string(), name.find(kRepeats) != std::string::npos));
  }

  MaterialLibrary& look_;
  std::filesystem::path folder_;
  std::vector<osg::ref_ptr<osg::Group>> unwanted_;
};

class DressWhatIsRead : public osgDB::ReadFileCallback {
 public:
  DressWhatIsRead(MaterialLibrary& look, std::filesystem::path folder) : look_(look), folder_(std::move(folder)) {}

  osgDB::ReaderWriter::ReadResult readNode(const std::string& file, const osgDB::Options* options) override {
    osgDB::ReaderWriter::ReadResult result = osgDB::ReadFileCallback::readNode(file, options);
    if (result.validNode()) {
      Dress dress(look_, folder_);
      result.getNode()->accept(dress);
      dress.Clear();
    }
    return result;
  }

  // The look reads pictures on the ground itself.
  osgDB::ReaderWriter::ReadResult readImage(const std::string& file, const osgDB::Options* options) override {
    if (file.find(kPictureFolder) != std::string::npos) return NoPicture().release();
    return osgDB::ReadFileCallback::readImage(file, options);
  }

 private:
  MaterialLibrary& look_;
  std::filesystem::path folder_;
};

// The tiles below groups; anything else is strange.
class FindTiles : public osg::NodeVisitor {
 public:
  explicit FindTiles(std::vector<osg::PagedLOD*>& tiles) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), tiles_(tiles) {}

  void apply(osg::PagedLOD& tile) override { tiles_.push_back(&tile); }
  void apply(osg::Group& group) override {
    if (typeid(group) != typeid(osg::Group))
      strange_ = true;
    else
      traverse(group);
  }
  void apply(osg::Node&) override { strange_ = true; }
  bool strange() const { return strange_; }

 private:
  std::vector<osg::PagedLOD*>& tiles_;
  bool strange_ = false;
};

}  // namespace

base::Result<PagedWorld> ReadBuilt(const std::filesystem::path& folder, MaterialLibrary& look) {
  look.MakeStates();
  const std::string file = (folder / "world.osgb").string();
  const osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(file);
  PagedWorld built;
  built.root = read.valid() ? read->asGroup() : nullptr;
  if (!built.root.valid()) return base::Failed("view.wrong_database", "OpenSceneGraph cannot read this file", file);
  const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
  options->setReadFileCallback(new DressWhatIsRead(look, folder));
  FindTiles find(built.tiles);
  built.root->accept(find);
  if (find.strange()) return base::Failed("view.wrong_database", "this is no database of tiles", file);
  for (osg::PagedLOD* tile : built.tiles) {
    tile->setDatabasePath(folder.string() + "/");
    tile->setDatabaseOptions(options);
  }
  return built;
}

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/visual_database/database.hpp"

#include <fmt/format.h>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PolygonOffset>
#include <osg/TexEnv>
#include <osgDB/Registry>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <span>
#include <sstream>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/view/scene/visual_world/seen_digest.hpp"
#include "common/world/road/visual_files.hpp"
#include "nodes/view/materials/face_texture.hpp"
#include "nodes/view/materials/model_file.hpp"
#include "nodes/view/materials/picture_texture.hpp"
#include "nodes/view/materials/plain_geometry.hpp"
#include "nodes/view/paging/database_tiles.hpp"
#include "nodes/view/paging/paged_world.hpp"

namespace rodeira::nodes {
namespace {

namespace fs = std::filesystem;

struct Known {
  base::Digest hash = 0;    // of the file
  base::Digest source = 0;  // of what it was made from
};
using Manifest = std::map<std::string, Known>;

// The files of the pictures, by their own names and by those that they have in the database.
using Pictures = std::map<std::string, std::string>;

// A tile refers to the picture; other programs read it from there.
void LayPicture(const scene::Mesh& mesh, const std::string& name, osg::Geometry& geometry) {
  osg::ref_ptr<osg::Image> image = NoPicture();
  image->setFileName("../" + name);
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  const auto wrap = mesh.repeats ? osg::Texture::REPEAT : osg::Texture::CLAMP_TO_EDGE;
  texture->setWrap(osg::Texture::WRAP_S, wrap);
  texture->setWrap(osg::Texture::WRAP_T, wrap);
  geometry.setName(geometry.getName() + (mesh.repeats ? kRepeats : "") + " " + name);
  geometry.setTexCoordArray(0, PlacesOnFace(mesh));
  geometry.getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
  geometry.getOrCreateStateSet()->setTextureAttributeAndModes(
      0, new osg::TexEnv(osg::TexEnv::DECAL));  // the picture's own colours
}

osg::ref_ptr<osg::Geometry> GeometryOf(const scene::Mesh& mesh, const Pictures& pictures) {
  osg::ref_ptr<osg::Geometry> geometry = PlainGeometry(mesh);
  geometry->setName(kGeometryName + std::to_string(static_cast<int>(mesh.material)));
  if (mesh.material == scene::Material::kMark) {  // over the ground that it lies in
    geometry->getOrCreateStateSet()->setAttributeAndModes(new osg::PolygonOffset(-1.0F, -4.0F));
    geometry->getOrCreateStateSet()->setRenderBinDetails(1, "RenderBin");
  }
  if (mesh.material == scene::Material::kSign) {  // the picture goes into the file
    osg::ref_ptr<osg::Texture2D> texture = MakeFaceTexture(mesh.face);
    texture->getImage()->setWriteHint(osg::Image::STORE_INLINE);
    geometry->setTexCoordArray(0, PlacesOnFace(mesh));
    geometry->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
  }
  if (mesh.material == scene::Material::kPicture) LayPicture(mesh, pictures.at(mesh.face), *geometry);
  return geometry;
}

osg::ref_ptr<osg::Node> StoredLevelNode(const scene::GroundLevel& level, const Pictures& pictures) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  const auto place = [&](const Eigen::Vector3d& origin_W, osg::Geometry* geometry) {
    osg::ref_ptr<osg::MatrixTransform> at =
        new osg::MatrixTransform(osg::Matrixd::translate(origin_W.x(), origin_W.y(), origin_W.z()));
    at->addChild(geometry);
    group->addChild(at);
  };
  const auto add = [&](const scene::Mesh& mesh, const char* more = "") {
    if (mesh.triangles.empty()) return;
    const osg::ref_ptr<osg::Geometry> geometry = GeometryOf(mesh, pictures);
    geometry->setName(geometry->getName() + more);
    place(mesh.origin_W, geometry);
  };
  for (const scene::Mesh& mesh : level.ground) add(mesh);
  add(level.marks);
  for (const scene::Mesh& mesh : level.things) add(mesh);
  for (const scene::Mesh& mesh : scene::Merged(level.repeated)) add(mesh, kMergedName);
  for (const scene::Repeated& repeated : level.repeated) {
    const osg::ref_ptr<osg::Geometry> geometry = RepeatedGeometry(repeated);
    geometry->setName(kGeometryName + std::to_string(static_cast<int>(repeated.model.material)) + kRepeatedName);
    geometry->setNodeMask(0U);
    place(repeated.origin_W, geometry);
  }
  if (!level.models.empty()) group->addChild(PlaceModels(level.models));
  return group;
}

// The bytes of a node's file. Not by several threads at once: the library's registry is one for all.
base::Result<std::string> Serialise(const osg::Node& node) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  osgDB::ReaderWriter* writer = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
  if (writer == nullptr)
    return base::Failed(
        "view.no_osg_plugin",
        "OpenSceneGraph's plugin for .osgb files is missing; the package libopenscenegraph161 was expected");
  std::ostringstream bytes;
  if (!writer->writeNode(node, bytes).success())
    return base::Failed("view.no_osg_plugin", "OpenSceneGraph cannot write .osgb files");
  return bytes.str();
}

Manifest ReadManifest(const fs::path& folder) {
  Manifest manifest;
  std::ifstream file(folder / road::kVisualManifest);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name;
    Known known;
    if (words >> std::hex >> known.hash >> known.source >> name) manifest[name] = known;
  }
  return manifest;
}

// Whether all files of a tile are there, made from the same, byte for byte as they were written.
bool IsFresh(const fs::path& folder, const Manifest& before, const TileFiles& tile, base::Digest source) {
  for (const TileLevel& level : tile.levels) {
    const auto known = before.find(level.file);
    if (known == before.end() || known->second.source != source) return false;
    std::ifstream file(folder / known->first, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    if (!file || base::Hash(bytes.view()) != known->second.hash) return false;
  }
  return true;
}

// A picture's kind in its name in the database, where it is a plain word.
std::string ExtensionOf(const fs::path& file) {
  const std::string extension = file.extension().string();
  const bool plain = extension.size() > 1 && std::all_of(extension.begin() + 1, extension.end(),
                                                         [](unsigned char c) { return std::isalnum(c) != 0; });
  return plain ? extension : "";
}

// Copies the world's pictures into the database.
base::Result<Pictures> WritePictures(const road::World& world, const fs::path& folder, Manifest& after) {
  Pictures pictures;
  for (const terrain::LaidPicture& picture : scene::PicturesOf(world)) {
    if (pictures.contains(picture.file)) continue;
    if (const auto facts = terrain::LookAtPicture(picture.file); !facts) return facts.error();
    const auto bytes = base::ReadText(picture.file, 1u << 30);
    if (!bytes) return bytes.error();
    const base::Digest hash = base::Hash(bytes.value());
    const std::string name = kPictureFolder + base::Hex(hash) + ExtensionOf(picture.file);
    std::error_code problem;
    fs::create_directories(folder / kPictureFolder, problem);
    if (auto written = base::WriteWhole(folder / name, std::as_bytes(std::span(bytes.value())), base::Durable::kLater);
        !written)
      return written.error();
    pictures[picture.file] = name;
    after[name] = {hash, hash};
  }
  return pictures;
}

// Makes a tile and writes its files.
base::Result<Manifest> WriteTile(const DatabaseTiles& tiles, std::size_t tile, const TileFiles& names,
                                 base::Digest source, const Pictures& pictures, const fs::path& folder) {
  const std::vector<scene::GroundLevel> levels = tiles.Make(tile);
  for (const scene::PlacedModel& model : levels.front().models) {
    if (auto read = ReadModel(model.file); !read) return read.error();
  }
  Manifest files;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const auto bytes = Serialise(*StoredLevelNode(levels[level], pictures));
    if (!bytes) return bytes.error();
    const std::string& name = names.levels[level].file;
    files[name] = {base::Hash(bytes.value()), source};
    if (auto written = base::WriteWhole(folder / name, std::as_bytes(std::span(bytes.value())), base::Durable::kLater);
        !written)
      return written.error();
  }
  return files;
}

}  // namespace

base::Result<DatabaseReport> WriteDatabase(const road::World& world, const DatabaseOptions& options) {
  std::error_code problem;
  fs::create_directories(options.folder / "tiles", problem);
  if (!fs::is_directory(options.folder / "tiles", problem))
    return base::WrongInput("file.not_folder", "this is no folder, and none can be made", options.folder.string());
  const Manifest before = ReadManifest(options.folder);
  const std::unique_ptr<DatabaseTiles> tiles = TilesOf(world, options.threads);
  const std::size_t count = tiles->count();

  Manifest after;
  const auto pictures = WritePictures(world, options.folder, after);
  if (!pictures) return pictures.error();
  std::vector<TileFiles> placed(count);
  DatabaseReport report;
  report.tiles = count;
  std::mutex mutex;  // of the four below
  base::Status status;
  std::size_t done = 0;
  // The longest pieces of work first, so that at the end no thread waits long for another one.
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return tiles->WorkOf(a) > tiles->WorkOf(b); });
  scene::ForEachAtOnce(count, options.threads, [&](std::size_t k) {
    const std::size_t i = order[k];
    const base::Digest source = tiles->SourceOf(i);
    const TileFiles& names = placed[i] = tiles->FilesOf(i);
    const bool fresh = IsFresh(options.folder, before, names, source);
    base::Result<Manifest> files = Manifest();
    if (fresh) {
      for (const TileLevel& level : names.levels) files.value()[level.file] = before.at(level.file);
    } else {
      files = WriteTile(*tiles, i, names, source, pictures.value(), options.folder);
    }
    const std::lock_guard lock(mutex);
    if (!files && status) status = files.error();
    if (files) after.merge(files.value());
    report.built += !fresh;
    options.progress(++done, count);
  });
  if (!status) return status.error();

  const auto root = Serialise(*PagedTree(placed).root);
  if (!root) return root.error();
  if (auto written = base::WriteWhole(options.folder / "world.osgb", root.value()); !written) return written.error();
  std::string manifest = fmt::format(
      "# The world {} as it is seen: hash of each file, hash of what it was made from, file\n# content_hash: {}\n# "
      "seen: {}\n{} {} world.osgb\n",
      world.name(), base::Hex(world.content_hash()), base::Hex(scene::SeenDigest(world)),
      base::Hex(base::Hash(root.value())), base::Hex(world.content_hash()));
  for (const auto& [name, known] : after)
    manifest += fmt::format("{} {} {}\n", base::Hex(known.hash), base::Hex(known.source), name);
  if (auto synced = base::SyncFolder(options.folder); !synced) return synced.error();  // the tiles before their list
  if (auto written = base::WriteWhole(options.folder / road::kVisualManifest, manifest); !written)
    return written.error();
  for (const auto& [name, known] : before) {
    if (name != "world.osgb" && !after.contains(name)) report.removed += fs::remove(options.folder / name, problem);
  }
  return report;
}

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/view/scene/mesh/mesh.hpp"
#include "common/world/network/lane.hpp"
#include "common/world/road/world.hpp"
#include "common/world/terrain/picture_file.hpp"

namespace rodeira::scene {

// Makes of a mesh one of kPicture; where its vertices lie on it is not said.
void Show(const terrain::LaidPicture& picture, Mesh& mesh);
// The same, and the picture lies on it as seen from above. What repeats is counted from a whole number of pictures near
// the mesh's origin, so that far from the world's origin nothing is lost.
void LayPicture(const terrain::LaidPicture& picture, Mesh& mesh);

// All that lie on a world's terrain and lanes, each once, in the order of the roads.
std::vector<terrain::LaidPicture> PicturesOf(const road::World& world);
// The picture of a lane's material; nothing where it has none.
std::optional<terrain::LaidPicture> PictureOf(const network::LaneMaterial& material);
// Digests of pictures; every file is read once.
class PictureDigests {
 public:
  // Of how it lies, of the file's bytes and of its kind by the file's name; paths are no part of it.
  base::Digest Of(const terrain::LaidPicture& picture);

 private:
  std::map<std::string, base::Digest> files_;
};
// Of all of a world's.
base::Digest PicturesDigest(const road::World& world);

}  // namespace rodeira::scene

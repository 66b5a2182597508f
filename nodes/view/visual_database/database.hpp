// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "common/core/base/result.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::nodes {

// Where the files go; `progress` is called with the tiles that are done and how many there are.
struct DatabaseOptions {
  std::filesystem::path folder;
  unsigned threads = 0;  // 0: as many as the machine has
  std::function<void(std::size_t done, std::size_t of)> progress = [](std::size_t, std::size_t) {};
};

// What was written.
struct DatabaseReport {
  std::size_t tiles = 0;
  std::size_t built = 0;    // the others were there already
  std::size_t removed = 0;  // files of tiles that are no more
};

// The names of geometries begin so; what follows is their scene::Material's number.
inline constexpr const char* kGeometryName = "rodeira ";
// What is repeated is there twice: merged, which every program draws, and as one model with its places
// (RepeatedGeometry), which is hidden from others. These words follow the number.
inline constexpr const char* kMergedName = " merged";
inline constexpr const char* kRepeatedName = " repeated";
// Of geometries on which a picture lies there follow, where it repeats, this word, and the file of the picture, which
// is copied into this folder under the hash of its bytes.
inline constexpr const char* kRepeats = " repeats";
inline constexpr const char* kPictureFolder = "pictures/";

// Writes the world as it is seen: `world.osgb` with a PagedLOD a tile, below groups of neighbouring ones (TileTree),
// `tiles/COLUMN_ROW_LEVEL.osgb`, and `visual.txt`, which names every file with its hash and what it was made from;
// pictures that lie on the ground are copied to `pictures/`. Tiles of unchanged sources, with files as
// they were written, stay. The bytes are the same for any number of threads and whatever was there before. Wrong input
// where a model or picture cannot be read, or the folder cannot be written.
base::Result<DatabaseReport> WriteDatabase(const road::World& world, const DatabaseOptions& options);

}  // namespace rodeira::nodes

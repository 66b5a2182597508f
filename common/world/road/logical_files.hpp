// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"

// A built folder holds what a world is beside what is seen of it: the world file with the files that it names, its
// terrain, its roads as OpenDRIVE.
namespace rodeira::road {

// The file that names each of them with its hash, below the world's content hash.
inline constexpr const char* kLogicalManifest = "logical.txt";

// Copies the files that a world file names by paths below its own folder to the same places below `folder`, with those
// that these name in turn (included files, an OpenCRG file's numbers) and their companions (of the same name with
// another ending: a projection, a picture's place, a model's materials). Returns their paths from `folder`, ascending.
// What a path names that leads out of the world file's folder, or is whole, stays where it is. Wrong input where a file
// cannot be read or written.
base::Result<std::vector<std::filesystem::path>> CopyNamed(const std::filesystem::path& world_file,
                                                           const std::filesystem::path& folder);

// Makes the folder, and a `logical.txt` without a world where there is none: what is written into the folder from now
// on is a build that has not ended.
base::Status BeginLogical(const std::filesystem::path& folder);

// Writes `logical.txt`. files: from the folder, in any order, once each.
base::Status WriteLogical(const std::filesystem::path& folder, base::Digest content_hash,
                          std::vector<std::filesystem::path> files);

// The world's content hash as `logical.txt` says it; empty where there is none.
std::string LogicalContentHash(const std::filesystem::path& folder);

// What is not as it was written; a folder without `logical.txt` is a problem. Empty: every file is there, byte for
// byte.
std::vector<base::Error> LogicalProblems(const std::filesystem::path& folder);

}  // namespace rodeira::road

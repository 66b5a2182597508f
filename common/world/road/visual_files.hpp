// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"

// What `visual.txt` (kVisualManifest) says: the files of what is seen of a world, and what they were written from.
namespace rodeira::road {

// The file that says what a visual database was written from, and what it consists of.
inline constexpr const char* kVisualManifest = "visual.txt";

// The lines of the file.
struct VisualContents {
  // A file with the hash that its bytes had when it was written.
  struct Listed {
    base::Digest hash = 0;
    std::string name;  // from the folder
  };
  std::string content_hash, seen;  // as they stand there: of the world, and of what is seen of it
  std::vector<Listed> files;
  std::vector<std::string> broken;  // lines that name no file with its hash
};

// Empty where the file cannot be read.
VisualContents ReadVisualContents(const std::filesystem::path& manifest);

// Each file that is missing or not as it was written, and each line that names none, in the order of the lines. Empty:
// what is seen is there byte for byte, or was not built into this folder: neither `visual.txt` nor `world.osgb` is
// there. content_hash: of the world that the folder holds, as hexadecimal digits; what was written from another one is
// a problem too.
std::vector<base::Error> VisualProblems(const std::filesystem::path& folder, const std::string& content_hash);

}  // namespace rodeira::road

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::road {

// The measured surfaces (OpenCRG files) that an exported OpenDRIVE file names: copies beside it, in a folder of its
// name, so that they can be moved together.
class MeasuredFiles {
 public:
  // exported: `town.xodr` has them in `town_surfaces/`.
  explicit MeasuredFiles(const std::filesystem::path& exported);
  // What the exported file says for a file (its whole path): the same for the same file, another for each other one.
  std::string NameOf(const std::string& file);
  // Writes all that were named. One that names another file ($ROAD_CRG_FILE) gets a copy of that beside it, and names
  // that. Wrong input where a file cannot be read or written.
  base::Status Write() const;

 private:
  std::filesystem::path parent_, folder_;
  std::map<std::string, std::string> names_;  // in the folder, by path
};

// The measured surfaces of a copy of an OpenDRIVE file: those that it names by a path below its own folder lie below
// the copy's as well. Warnings: of those which the copy does not find, as their path leaves the folder. To `copied`,
// where it is not null, the paths of what lies below the copy's folder now are added, counted from there.
base::Result<std::vector<std::string>> CopyMeasured(const std::filesystem::path& open_drive,
                                                    const std::filesystem::path& copy,
                                                    std::vector<std::filesystem::path>* copied = nullptr);

}  // namespace rodeira::road

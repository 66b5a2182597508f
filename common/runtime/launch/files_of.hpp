// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"

namespace rodeira::launch {

// A file that a run was made of, by its path relative to the launch file's folder ("../configs/worlds/n222.yaml").
struct NamedFile {
  std::string name;
  base::Bytes bytes;
};

// Everything that a launch file says: itself first, then each file that it names, and what those name if they are YAML.
// A value with an extension names a file where one exists at that place, relative to the file in which the value
// stands; one named by its whole path is "absolute/…". What a recorder writes to, and files of more than 64 MiB, are
// left out.
base::Result<std::vector<NamedFile>> FilesOf(const Launch& launch);

// Lays the files out below `folder` as they lay around the launch file, which is the first, and names those by their
// place there that the launch file names by their whole path; returns its path. Wrong input where a name would lead out
// of the folder.
base::Result<std::filesystem::path> LayOut(const std::vector<NamedFile>& files, const std::filesystem::path& folder);

// The value of an override, in a launch file that was laid out: where it names a file by its whole path, the laid out
// copy.
std::string LaidOut(const std::string& value, const std::filesystem::path& launch_file);

// A sentence about files that were laid out below `folder`: each path is said by its name, as it stands in NamedFile.
std::string WithNames(std::string text, const std::filesystem::path& folder);

}  // namespace rodeira::launch

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/world/road/world.hpp"

namespace rodeira::nodes {

// A database (`rodeira world build`) beside a world's file: in its folder, or in the folder that is named as it is
// without its ending.
struct FoundBuilt {
  std::filesystem::path folder;  // empty: there is none that could be shown
  std::string remark;            // why one that is there is not; for people
};

// The database is shown where it was written from what the world looks like now, and each of its files is there, byte
// for byte as it was written.
FoundBuilt FindBuilt(const std::filesystem::path& world_file, const road::World& world);

}  // namespace rodeira::nodes

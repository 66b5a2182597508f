// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/core/base/log.hpp"
#include "common/core/base/result.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::cli {

// Loads a world for a command, and writes what was repaired in an OpenDRIVE file to standard error: one line a kind.
inline base::Result<std::shared_ptr<const road::World>> LoadWorldAndWarn(const std::filesystem::path& file) {
  auto world = road::World::Load(file);
  if (world) {
    for (const std::string& warning : world.value()->warnings()) base::Log(base::LogLevel::kWarning, "", warning);
  }
  return world;
}

}  // namespace rodeira::cli

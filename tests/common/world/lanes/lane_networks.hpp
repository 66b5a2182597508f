// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/core/base/assert.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/traffic_map/map_network.hpp"
#include "tests/tree.hpp"

// Networks to try things on: the project's maps, and the real files where they lie beside the project.
namespace rodeira::lanes {

inline std::shared_ptr<const network::Network> MapNetwork(const std::string& name) {
  auto made = traffic_map::LoadNetwork(std::filesystem::path(SourceDir()) / "configs/maps" / (name + ".motors"));
  RODEIRA_ASSERT(made.ok());
  return made.value();
}

inline std::vector<std::string> MapNames() { return {"crossing", "roundabout", "ramp", "town", "overpass", "lights"}; }

inline std::filesystem::path RealFolder() { return std::filesystem::path(SourceDir()) / "../shared/data/road/xodr"; }

inline std::vector<std::filesystem::path> RealFiles() {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(RealFolder(), none)) {
    if (entry.path().extension() == ".xodr") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace rodeira::lanes

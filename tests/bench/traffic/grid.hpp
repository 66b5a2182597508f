// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

namespace rodeira::traffic {

inline constexpr const char* kNoGrids = "RODEIRA_GRIDS names no folder with the grids of tools/make_grid.py";

// The file of a town of so many streets each way; empty where RODEIRA_GRIDS is not set.
inline std::string Grid(std::int64_t nodes) {
  const char* folder = std::getenv("RODEIRA_GRIDS");
  return folder == nullptr ? "" : std::string(folder) + "/grid" + std::to_string(nodes) + ".motors";
}

}  // namespace rodeira::traffic

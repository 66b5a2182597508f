// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/surface/crg_surface.hpp"

namespace rodeira::surface {

// An OpenCRG file, understood.
struct CrgFile {
  CrgHeader header;  // of the file that holds the numbers
  std::shared_ptr<const CrgSurface> surface;
  std::vector<std::string> warnings;
};

// Reads an OpenCRG file (ASAM OpenCRG 1.0 to 1.2). One that names another ($ROAD_CRG_FILE) gives it its options and
// modifiers; the name is taken relative to the file that it stands in, and no name leads to a third file.
// Modifiers are applied where a file has a section of them. A file without one keeps its own place, and heights that
// are missing at its sides are those of the outermost section that is there.
// Wrong input, with file and line, where anything is missing, broken, out of range or does not fit together.
base::Result<CrgFile> LoadCrg(const std::filesystem::path& path);

// The same from bytes, which must hold the numbers themselves; `name` stands for the path in messages.
base::Result<CrgFile> ParseCrg(std::span<const std::byte> bytes, const std::string& name);

}  // namespace rodeira::surface

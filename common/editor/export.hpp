// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"
#include "common/editor/document.hpp"

namespace rodeira::editor {

// The map as a world of this project: FILE.yaml, a world file that `rodeira world check` and `rodeira run` take, and
// its roads as OpenDRIVE 1.7 beside it, FILE.xodr. The latter alone where `path` ends so. Each file is whole or not
// there; a sentence about what was written comes back. Wrong input where the map is none that can be driven on, failed
// where a file cannot be written.
base::Result<std::string> Export(const Document& document, const std::filesystem::path& path);

}  // namespace rodeira::editor

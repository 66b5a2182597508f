// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"
#include "common/editor/document.hpp"

namespace rodeira::editor {

// Exports the map as a world: FILE.yaml, a world file for `rodeira world check` and `rodeira run`, and beside it
// FILE.xodr, its roads as OpenDRIVE 1.7. If `path` ends in .xodr, only that file. Files are written atomically. Returns
// a sentence about what was written. Wrong input if the map has no drivable road, failed if a file cannot be
// written.
base::Result<std::string> Export(const Document& document, const std::filesystem::path& path);

}  // namespace rodeira::editor

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/world/opendrive/file_text.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/opendrive/source.hpp"

// A file is read, its errors are repaired by changes of its text, and the text is read again, until no error asks for
// a change. So the repaired file is what was read.
namespace rodeira::opendrive {

// One reading. Every error says how it is repaired; errors without anything done leave nothing to read.
base::Result<Import> ReadOnce(const std::string& text, const std::filesystem::path& path, const Tolerance& tolerance,
                              const Edited* edited);
// All rounds of reading and repair; the import's warnings say what was repaired.
base::Result<Import> ReadRepaired(FileText file, const std::filesystem::path& path, const Tolerance& tolerance);

}  // namespace rodeira::opendrive

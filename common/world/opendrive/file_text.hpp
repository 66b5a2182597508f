// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"
#include "common/world/opendrive/source.hpp"

namespace rodeira::opendrive {

// An OpenDRIVE file as one text: unpacked, in UTF-8, with the files that it includes in the place of their <include>.
struct FileText {
  std::string text;
  Edited edited;  // lines are those of the unpacked file; what was included counts as the line of its <include>
};

// A file is unpacked by its first bytes, whatever its name: gzip, or a ZIP archive that holds one OpenDRIVE file, or
// one that includes all others.
// Includes are relative to the file that names them, in an archive those of the archive. One that cannot be read stays
// in the text, and Edited::unread says why. Wrong input where the file cannot be read, is no XML, or includes itself.
base::Result<FileText> ReadFileText(const std::filesystem::path& path);

}  // namespace rodeira::opendrive

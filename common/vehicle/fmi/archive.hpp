// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/core/base/result.hpp"
#include "common/core/base/temporary_folder.hpp"

namespace rodeira::fmi {

// Lays a ZIP archive's files out in a new folder. Wrong input where it is none, is damaged, holds more than 1 GiB, or a
// name in it leads out of the folder.
base::Result<base::TemporaryFolder> Unpack(const std::filesystem::path& archive);

}  // namespace rodeira::fmi

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/core/base/result.hpp"

namespace rodeira::base {

// Gives what is written at `from` the name `to`, on the same file system; what had that name is gone. The name is on
// the disk when this returns. What is in a file at `from` must be on the disk already: otherwise a loss of power may
// leave the name with half of it.
Status PutInPlace(const std::filesystem::path& from, const std::filesystem::path& to);

// Waits until the name of a new file is on the disk, which a sync of the file alone does not promise. Best effort: a
// folder that cannot be opened or synced keeps the name all the same as soon as the system writes it.
void SyncName(const std::filesystem::path& path);

}  // namespace rodeira::base

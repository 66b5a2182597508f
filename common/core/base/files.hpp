// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"

namespace rodeira::base {

// The whole file, or what comes through a pipe until it is closed. Wrong input where it is missing, is a folder, or is
// larger than `limit_bytes`.
Result<std::string> ReadText(const std::filesystem::path& path, std::size_t limit_bytes = 64u << 20);
Result<Bytes> ReadBytes(const std::filesystem::path& path, std::size_t limit_bytes = 1u << 30);

// Whether a file is on the disk, or only handed to the system, when a function that writes it returns.
enum class Durable { kNow, kLater };
// Writes beside the target and renames: the file is the old one or the whole new one, never half of it, also after a
// loss of power. kLater is for many files at a time: that holds once SyncFolder has returned.
Status WriteWhole(const std::filesystem::path& path, std::span<const std::byte> bytes, Durable durable = Durable::kNow);
Status WriteWhole(const std::filesystem::path& path, std::string_view text);
// Waits until everything written below `folder`, and on the rest of its file system, is on the disk.
Status SyncFolder(const std::filesystem::path& folder);

}  // namespace rodeira::base

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "common/core/base/result.hpp"

namespace rodeira::dds {

inline const std::filesystem::path kSharedMemoryFolder = "/dev/shm";

// Bytes of files that one process of a run makes in shared memory, with a segment of this size.
std::uint64_t SharedMemoryNeed(std::uint32_t segment_kib);

// Bytes that are free there; failed if it cannot be asked.
base::Result<std::uint64_t> FreeSharedMemory(const std::filesystem::path& folder = kSharedMemoryFolder);
// Failed if fewer bytes are free: of a page that cannot be had a process learns by a bus error.
base::Status CheckSpace(std::uint64_t bytes, const std::filesystem::path& folder = kSharedMemoryFolder);
// The same, and takes the pages for a moment. Nothing is left there.
base::Status TryRoom(std::uint64_t bytes, const std::filesystem::path& folder = kSharedMemoryFolder);

// Takes all pages of the segment that Fast DDS has made for this process, which takes them only when it writes. Failed
// if they cannot be had.
base::Status ClaimOwnSegment();

// Whether this process can still map a segment of another process. Fast DDS maps it when the first message arrives;
// where it cannot, it passes over this message and all later ones without an error.
base::Status CheckAddressSpace(std::uint32_t segment_kib);

}  // namespace rodeira::dds

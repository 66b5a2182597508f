// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace rodeira::cli {

// Names of Fast DDS's files in /dev/shm (segments, ports and their semaphores).
std::set<std::string> SharedMemoryFiles(const std::filesystem::path& folder = "/dev/shm");

// Those that are this user's, did not exist before (`before`), and that no living process has mapped or open: what dead
// processes left behind.
std::set<std::string> DeadFiles(const std::set<std::string>& before, const std::filesystem::path& folder = "/dev/shm");

// Whether a process that lives, or one of another container, has locked the file by flock(2). A process that was killed
// and has not ended (KilledBy) is dead. False where there is no such file.
bool IsLockedByLiving(const std::filesystem::path& file);

// Removes them. Returns how many.
int RemoveLeftOvers(const std::set<std::string>& before, const std::filesystem::path& folder = "/dev/shm");

}  // namespace rodeira::cli
